// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lidar_upsampling/tracks/hypotheses.h"
#include "lidar_upsampling/tracks/scan_factor.h"
#include "lidar_upsampling/units.h"

#include "tracks/car_on_pictures.h"
#include "tracks/objects_scan.h"

namespace lidar_upsampling {
namespace {

using testing::ahead;
using testing::kStart;

constexpr double kYaw = 50 * kDegree;  // of the car, as the lidar sees it
const Eigen::Vector3d kPlace(20, 3, 0);

Eigen::Vector3d direction(double yaw) { return {std::cos(yaw), std::sin(yaw), 0}; }

/// The two sides of a car that a lidar at the origin sees.
std::vector<Eigen::Vector3d> crossing_car() {
  const Eigen::Vector3d along = direction(kYaw), across = direction(kYaw + M_PI / 2);
  std::vector<Eigen::Vector3d> points;
  for (const double up : {-0.6, -0.2, 0.2, 0.6}) {
    const Eigen::Vector3d middle = kPlace + Eigen::Vector3d(0, 0, up);
    for (double d = -2.1; d < 2.1; d += 0.2) points.emplace_back(middle + d * along - 0.9 * across);
    for (double d = -0.9; d < 0.9; d += 0.2) points.emplace_back(middle - 2.1 * along + d * across);
  }
  return points;
}

/// What of a person a lidar at the origin sees.
std::vector<Eigen::Vector3d> person() {
  std::vector<Eigen::Vector3d> points;
  for (double up = -0.8; up < 0.9; up += 0.2)
    for (const double aside : {-0.2, -0.1, 0., 0.1, 0.2})
      points.emplace_back(kPlace + Eigen::Vector3d(0, aside, up));
  return points;
}

/// @param lidar_yaw of the lidar in the frame at rest.
ObjectTrack first_sight(double lidar_yaw,
                        const std::vector<Eigen::Vector3d>& points = crossing_car(),
                        const std::string& class_name = "car") {
  LidarScan scan;
  scan.stamp = kStart;
  ScanObject object;
  object.class_name = class_name;
  for (const Eigen::Vector3d& point : points) {
    object.points.push_back(static_cast<int>(scan.points.size()));
    scan.points.emplace_back(point.cast<float>());
  }
  object.centroid = kPlace;
  object.length = 4.2;
  const Pose T_rest_lidar(Eigen::AngleAxisd(lidar_yaw, Eigen::Vector3d::UnitZ()));
  const Matrix6d none = Matrix6d::Zero();
  const auto seen = testing::unknown_space();
  std::vector<ScanObject> objects{object};
  TrackStore store;
  take_up_scan(store, objects, {scan, T_rest_lidar, none, seen}, {});
  return store.tracks.front();
}

double speed_variance(const Course& course, double yaw) {
  const Eigen::Vector2d d = direction(yaw).head<2>();
  return d.dot(course.from.covariance.block<2, 2>(3, 3) * d);
}

TEST(NewObject, that_looks_like_a_pole_hardly_moves_until_it_looks_like_a_truck) {
  ObjectTrack track = first_sight(0, person(), "pole");
  const double as_object = first_sight(0, person(), "object").log_odds;
  EXPECT_NEAR(track.log_odds, as_object + std::log(0.1), 1e-9);
  track.log_odds += 3;  // by what was seen since
  EXPECT_NEAR(log_odds_at(kStart, "pole", track, track.log_odds, {}), track.log_odds, 1e-9);
  EXPECT_NEAR(log_odds_at(kStart, "truck", track, track.log_odds, {}), as_object + 3, 1e-9);
  EXPECT_NEAR(log_odds_at(shifted(kStart, 100), "truck", track, track.log_odds, {}), as_object,
              1e-6);
}

TEST(NewObject, may_go_anywhere_or_along_our_road_or_along_its_own_sides) {
  constexpr double kLidarYaw = 0.4;
  const ObjectTrack track = first_sight(kLidarYaw);
  double sum = 0, aside = 0;
  for (const Course& course : track.beginnings) {
    sum += course.probability;
    const double yaw = kYaw + kLidarYaw;
    if (speed_variance(course, yaw + M_PI / 2) > 0.1 * speed_variance(course, yaw)) continue;
    aside += course.probability;
  }
  EXPECT_EQ(track.beginnings.size(), 3U);
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(aside, 0.25, 1e-9);
}

/// Of the motion that noisy pictures 33 ms after the first sight tell, on average, m.
double mean_error(const ObjectTrack& track, const std::vector<Eigen::Vector3d>& points,
                  const Twist& truth) {
  MotionQuestion question;
  question.instant = shifted(kStart, 0.033);
  question.centroid = kPlace;
  question.num_followed = static_cast<int>(points.size());
  const Pose T = ahead() * motion_pose(truth, kPlace);
  double mean = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 0.6 / 700);
    std::vector<Observation> seen;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d at = T * point;
      seen.push_back({point, at.head<2>() / at.z() + Eigen::Vector2d(noise(random), noise(random)),
                      700 * Eigen::Matrix2d::Identity(), static_cast<int>(seen.size())});
    }
    ImageFactor image;
    image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen);
    const MotionAnswer answer = estimate_motion(track, image, question, {truth}, {});
    mean += (answer.moving.mean - truth).tail<3>().norm() / 20;
  }
  return mean;
}

Twist moved(const Eigen::Vector3d& by) {
  Twist truth = Twist::Zero();
  truth.tail<3>() = by;
  return truth;
}

// A noisy picture taken soon tells little of how far something has come nearer.
TEST(NewObject, comes_nearer_as_its_sides_tell_where_the_picture_does_not) {
  const ObjectTrack track = first_sight(0);
  ObjectTrack of_no_shape = track;
  of_no_shape.beginnings = {{new_track_state(kStart, {}), 1}};
  const Twist truth = moved(0.3 * direction(kYaw));  // 9 m/s
  EXPECT_LT(mean_error(track, crossing_car(), truth),
            0.5 * mean_error(of_no_shape, crossing_car(), truth));
}

TEST(NewObject, goes_on_foot_if_it_looks_like_a_person) {
  const Twist truth = moved({0, 0.05, 0});  // 1.5 m/s
  const double as_person = mean_error(first_sight(0, person(), "person"), person(), truth);
  EXPECT_LT(as_person, 0.07);
  EXPECT_LT(as_person, 0.5 * mean_error(first_sight(0, person(), "object"), person(), truth));
}

// A rider, from behind.
TEST(NewObject, may_go_fast_though_it_looks_like_a_person) {
  const Twist truth = moved({0, 0.5, 0});  // 15 m/s
  EXPECT_LT(mean_error(first_sight(0, person(), "person"), person(), truth), 0.15);
}

}  // namespace
}  // namespace lidar_upsampling
