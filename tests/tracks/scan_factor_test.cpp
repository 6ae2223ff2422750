// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/scan_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lidar_upsampling/tracks/log_odds.h"
#include "tracks/car_on_pictures.h"
#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;
using testing::street_with;

constexpr float kLength_m = 4;

// The flat side of a car that passes us on the left.
std::vector<Eigen::Vector3f> flat_side(float rear, float column_m) {
  std::vector<Eigen::Vector3f> points;
  const float ring_m = std::max(0.1F, column_m / 4);
  for (float x = rear; x <= rear + kLength_m; x += column_m)
    for (float z = -1.2F; z < 0.3F; z += ring_m) points.emplace_back(x, 3.5F, z);
  return points;
}

// What two scans tell of it, so far apart, of a vehicle that has gone so far.
ScanLesson lesson_of(float rear_before, float rear_now, double ego_m = 0, float column_m = 0.05F,
                     double dt_s = 0.1) {
  const auto before = flat_side(rear_before, column_m), now = flat_side(rear_now, column_m);
  const auto seen_now = std::make_shared<const SeenSpace>(street_with(now));
  const TrackOptions options;
  ObjectTrack track;
  track.stamp = kStart;
  track.T_rest_lidar = Pose::Identity();
  track.seen = std::make_shared<const SeenSpace>(street_with(before));
  track.surface = std::make_shared<const Surface>(before);
  track.centroid_rest = mean_of(before);
  track.length = kLength_m;
  track.state = track.by_scans = track.latest = new_track_state(kStart, options.noise);
  track.log_odds = track.latest_log_odds = log_odds_of(options.moving_prior);
  LidarScan scan;
  scan.stamp = shifted(kStart, dt_s);
  scan.points = now;
  ScanObject object;
  object.points.resize(now.size());
  std::iota(object.points.begin(), object.points.end(), 0);
  object.centroid = mean_of(now);
  object.length = kLength_m;
  const Pose T_rest_lidar(Eigen::Translation3d(ego_m, 0, 0));
  const Matrix6d exact = Matrix6d::Zero();
  return learn_from_scans(track, object, Surface(now), {scan, T_rest_lidar, exact, seen_now},
                          options);
}

TEST(ScanFactor, knows_by_its_ends_how_far_a_flat_side_has_gone) {
  const ScanLesson lesson = lesson_of(4, 5.1F);
  EXPECT_NEAR(lesson.state.mean[0], 1.1, 0.1);
  EXPECT_LT(std::sqrt(lesson.state.covariance(0, 0)), 0.15);
  EXPECT_GT(lesson.log_odds, 2);
}

TEST(ScanFactor, knows_by_its_ends_that_a_flat_side_stands) {
  const ScanLesson lesson = lesson_of(4, 4);
  EXPECT_NEAR(lesson.state.mean[0], 0, 0.1);
  EXPECT_LT(lesson.log_odds, -2);
}

TEST(ScanFactor, knows_it_though_a_scan_between_has_missed_the_side) {
  const ScanLesson lesson = lesson_of(4, 6.2F, 0, 0.05F, 0.2);
  EXPECT_NEAR(lesson.state.mean[0], 2.2, 0.1);
  EXPECT_LT(std::sqrt(lesson.state.covariance(0, 0)), 0.15);
}

TEST(ScanFactor, trusts_a_step_less_that_the_beams_themselves_have_made) {
  const ScanLesson moved = lesson_of(4, 5), kept_to_us = lesson_of(4, 4, 1);
  EXPECT_NEAR(kept_to_us.state.mean[0], moved.state.mean[0], 0.1);
  EXPECT_LT(kept_to_us.log_odds, moved.log_odds - 1);
}

TEST(ScanFactor, knows_the_end_of_a_side_no_better_than_the_beams_on_it_are_apart) {
  const ScanLesson dense = lesson_of(4, 4.5F), sparse = lesson_of(4, 4.5F, 0, 1.2F);
  EXPECT_GT(std::sqrt(sparse.state.covariance(0, 0)), 0.2);
  EXPECT_GT(dense.log_odds, 0);
  EXPECT_LT(sparse.log_odds, 0);
}

}  // namespace
}  // namespace lidar_upsampling
