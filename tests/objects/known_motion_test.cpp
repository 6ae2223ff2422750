// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/known_motion.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

constexpr double kPeriod = 0.1;

// The rear of a vehicle ahead at `x`, and its left side for `length` metres.
std::vector<Eigen::Vector3f> vehicle(float x, float length, float half_width = 0.9F) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1.2F; z < 0.3F; z += 0.15F) {
    for (float y = -half_width; y <= half_width; y += 0.1F) points.emplace_back(x, y, z);
    for (float along = 0.1F; along < length; along += 0.1F) points.emplace_back(x + along, 0.9F, z);
  }
  return points;
}

std::optional<KnownMotion> measured(std::vector<Eigen::Vector3f> before,
                                    std::vector<Eigen::Vector3f> now) {
  ObjectScans scans;
  scans.before = std::move(before);
  scans.now = std::move(now);
  scans.dt = kPeriod;
  return measure_between_scans(scans, Stamp{}, Eigen::Matrix3d::Identity());
}

TEST(MeasureBetweenScans, a_piece_of_a_rear_tells_the_motion_ahead_but_not_that_sideways) {
  const auto known = measured(vehicle(12, 0, 0.5F), vehicle(12.2F, 0));
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->velocity_at_rest.x(), 2, 0.2);
  EXPECT_LT(std::sqrt(known->velocity_covariance(0, 0)), 0.5);
  EXPECT_GT(known->velocity_covariance(1, 1), 10 * known->velocity_covariance(0, 0));
  EXPECT_GT(evidence_of_motion(*known), 16.8);
}

TEST(MeasureBetweenScans, a_view_that_shrinks_is_found_in_the_larger_one_before) {
  const auto known = measured(vehicle(12, 4), vehicle(12.3F, 0.5F));
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->velocity_at_rest.x(), 3, 0.3);
}

TEST(MeasureBetweenScans, no_road_user_jumps_up) {
  auto now = vehicle(12, 2);
  for (auto& point : now) point.z() += 0.4F;
  EXPECT_FALSE(measured(vehicle(12, 2), now));
}

KnownMotion velocity(double x, double y, double sigma_x, double sigma_y) {
  KnownMotion known;
  known.velocity_at_rest = {x, y, 0};
  known.velocity_covariance.diagonal() << sigma_x * sigma_x, sigma_y * sigma_y;
  return known;
}

TEST(FusedMotion, follows_in_each_direction_who_knows_it) {
  // The side of a car slides along itself; on the picture it does not.
  const KnownMotion both = fused(velocity(4, 0.5, 0.3, 2), velocity(1.8, 0, 5, 0.1), 3);
  EXPECT_NEAR(both.velocity_at_rest.x(), 4, 0.15);
  EXPECT_NEAR(both.velocity_at_rest.y(), 0, 0.01);
  EXPECT_LT(both.velocity_covariance(0, 0), 1.1);
  EXPECT_LE(both.velocity_covariance(1, 1), 0.01);
}

TEST(FusedMotion, is_the_newer_one_where_they_contradict_each_other) {
  EXPECT_NEAR(fused(velocity(9, 0, 0.1, 0.1), velocity(2, 0, 0.1, 0.1), 3).velocity_at_rest.x(), 2,
              1e-9);
}

TEST(FusedMotion, hardly_trusts_what_was_long_ago) {
  KnownMotion newer = velocity(0, 0, 0.5, 0.5);
  newer.stamp = shifted(newer.stamp, 2);
  EXPECT_LT(fused(velocity(1, 0, 0.1, 0.1), newer, 3).velocity_at_rest.x(), 0.02);
}

TEST(ExpectMotion, is_as_wide_in_each_direction_as_the_velocity_was_unsure) {
  KnownMotion known;
  known.velocity_covariance << 0.01, 0, 0, 25;
  const MotionPrior prior = expect_motion(known, known.stamp, Eigen::Matrix3d::Identity(),
                                          Eigen::Vector3d(10, 0, 0), 0.1, MotionPriorOptions());
  EXPECT_GT(prior.position_covariance(1, 1), 50 * prior.position_covariance(0, 0));
}

}  // namespace
}  // namespace lidar_upsampling
