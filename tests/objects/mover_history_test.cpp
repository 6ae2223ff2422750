// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/mover_history.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr double kSpeed = 8;  // m/s, along x

Stamp scan_stamp(int scan) { return shifted(Stamp{}, kPeriod_s * scan); }

// The rear of a vehicle whose left end is at (x, 0), sensed with rings 0.2 m apart.
std::vector<Eigen::Vector3f> rear_face(float x) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1.2F; z < 0.3F; z += 0.2F)
    for (float y = -1.8F; y < 0.05F; y += 0.1F) points.emplace_back(x, y, z);
  return points;
}

Mover mover_at(double x, int scan, double speed = kSpeed) {
  KnownMotion motion;
  motion.stamp = scan_stamp(scan);
  motion.velocity_at_rest = {speed, 0, 0};
  motion.velocity_covariance = 0.2 * 0.2 * Eigen::Matrix2d::Identity();
  return make_mover("car", rear_face(static_cast<float>(x)), motion);
}

// The ego stands; a car is at x = 20 m at the first of five scans and drives off.
MoverHistory history_of_one_seen_from(int first) {
  MoverHistory history;
  for (int scan = 0; scan < 5; ++scan) {
    history.push_back({scan_stamp(scan), Pose::Identity(), {}});
    if (scan >= first)
      history.back().movers.push_back(mover_at(20 + kSpeed * kPeriod_s * scan, scan));
  }
  return history;
}

std::vector<ExpectedMover> expected_at(const MoverHistory& history, int scan) {
  return movers_of_later_scans(history, scan_stamp(scan), Eigen::Matrix3d::Identity(), {});
}

TEST(MoversOfLaterScans, who_is_seen_to_move_later_is_expected_where_it_must_have_been) {
  const auto expected = expected_at(history_of_one_seen_from(2), 0);
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_NEAR(mean_of(expected[0].points).x(), 20, 1e-3);
  EXPECT_EQ(expected[0].motion.velocity_at_rest.x(), kSpeed);
  EXPECT_EQ(expected[0].motion.stamp, scan_stamp(0));
  EXPECT_EQ(expected[0].class_name, "car");
  EXPECT_FALSE(expected[0].is_shown);
  // Until then it may have sped up.
  EXPECT_GT(expected[0].motion.velocity_covariance(0, 0), 0.2 * 0.2);
}

TEST(MoversOfLaterScans, it_is_the_egos_frame_in_which_they_are_expected) {
  MoverHistory history = history_of_one_seen_from(1);
  history[0].T_rest_lidar = Eigen::Translation3d(5, 1, 0) * Pose::Identity();
  const auto expected = expected_at(history, 0);
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_NEAR(mean_of(expected[0].points).x(), 15, 1e-3);
  EXPECT_NEAR(mean_of(expected[0].points).y(), -1.9, 1e-3);
}

TEST(MoversOfLaterScans, who_was_seen_to_move_already_is_said_to) {
  const auto expected = expected_at(history_of_one_seen_from(0), 0);
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_TRUE(expected[0].is_shown);
}

TEST(MoversOfLaterScans, the_sights_after_the_next_one_tell_its_velocity_too) {
  MoverHistory history = history_of_one_seen_from(1);
  KnownMotion& guess = history[1].movers[0].motion;
  guess.velocity_at_rest.x() = kSpeed - 1.4;
  guess.velocity_covariance = 2 * 2 * Eigen::Matrix2d::Identity();
  const auto expected = expected_at(history, 0);
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_GT(expected[0].motion.velocity_at_rest.x(), kSpeed - 0.6);
}

TEST(MoversOfLaterScans, one_scan_alone_is_not_believed) {
  MoverHistory history = history_of_one_seen_from(2);
  history.resize(3);
  EXPECT_TRUE(expected_at(history, 0).empty());
}

TEST(MoversOfLaterScans, one_that_is_elsewhere_in_the_further_scans_is_not_believed) {
  MoverHistory history = history_of_one_seen_from(5);
  history[2].movers.push_back(mover_at(20, 2));
  for (int scan = 3; scan < 5; ++scan) history[scan].movers.push_back(mover_at(20, scan, 0.1));
  EXPECT_TRUE(expected_at(history, 0).empty());
}

TEST(MoversOfLaterScans, another_log_has_no_say) {
  EXPECT_TRUE(expected_at(history_of_one_seen_from(2), 7).empty());
}

TEST(PointsOfMover, are_those_near_it_but_the_ground) {
  LidarScan scan;
  scan.points = rear_face(20.05F);
  const std::size_t num_own = scan.points.size();
  scan.points.emplace_back(20, 1.5F, 0);    // beside
  scan.points.emplace_back(20, -1, -1.4F);  // below
  std::vector<std::uint8_t> is_ground(scan.points.size(), 0);
  is_ground.back() = 1;
  const auto points = points_of_mover({"car", rear_face(20), {}, 0.1}, scan, is_ground);
  ASSERT_EQ(points.size(), num_own);
  EXPECT_EQ(points.back(), static_cast<int>(num_own) - 1);
}

TEST(MakeMover, thins_a_large_object_evenly) {
  const std::vector<Eigen::Vector3f> many(10000, Eigen::Vector3f(1, 2, 3));
  EXPECT_LE(make_mover("truck", many, {}).points.size(), 400U);
}

}  // namespace
}  // namespace lidar_upsampling
