// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/centroid_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracks/car_on_pictures.h"
#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;
using testing::street_with;
using Points = std::vector<Eigen::Vector3f>;

// A metre of a car that crosses 12 m ahead.
Points piece_of_car() {
  Points points;
  for (float y = -0.5F; y < 0.5F; y += 0.04F)
    for (float z = -1; z < 0; z += 0.08F) points.emplace_back(12, y, z);
  return points;
}

// Two posts 8 m ahead, between which it is seen.
Points posts() {
  Points points;
  for (const float side : {-1.F, 1.F})
    for (float y = 0.36F; y < 0.8F; y += 0.02F)
      for (float z = -0.9F; z < 0.4F; z += 0.05F) points.emplace_back(8, side * y, z);
  return points;
}

Points joined(Points points, const Points& others) {
  points.insert(points.end(), others.begin(), others.end());
  return points;
}

// Of that piece, at the same place in two scans.
PlanarStep step_among(const Points& others) {
  const Points piece = piece_of_car();
  const auto seen = std::make_shared<const SeenSpace>(street_with(joined(piece, others)));
  ObjectTrack track;
  track.stamp = kStart;
  track.seen = seen;
  track.surface = std::make_shared<const Surface>(piece);
  ScanObject object;
  object.centroid = track.centroid_rest = mean_of(piece);
  object.length = track.length = track.whole_length = 1;
  LidarScan scan;
  scan.stamp = shifted(kStart, 0.1);
  scan.points = piece;
  const Pose T_rest_lidar = Pose::Identity();
  const Matrix6d exact = Matrix6d::Zero();
  return centroid_step(track, object, *track.surface, {scan, T_rest_lidar, exact, seen}, {});
}

double sigma(const PlanarStep& step, int axis) { return std::sqrt(step.covariance(axis, axis)); }

TEST(CentroidStep, is_the_objects_own_where_all_of_it_is_seen) {
  const PlanarStep step = step_among({});
  EXPECT_LT(sigma(step, 0), 0.3);
  EXPECT_LT(sigma(step, 1), 0.3);
}

TEST(CentroidStep, may_be_of_what_comes_into_sight_between_two_posts) {
  const PlanarStep step = step_among(posts());
  EXPECT_GT(sigma(step, 1), 1.5);
  EXPECT_LT(sigma(step, 0), 0.3);  // along the line of sight nothing hides
}

}  // namespace
}  // namespace lidar_upsampling
