// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/motion_to_next.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

constexpr double kPeriod = 0.1;

// The rear of a vehicle ahead at `x`, and its left side.
std::vector<Eigen::Vector3f> vehicle(float x) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1.2F; z < 0.3F; z += 0.15F) {
    for (float y = -0.9F; y <= 0.9F; y += 0.1F) points.emplace_back(x, y, z);
    for (float along = 0.1F; along < 3; along += 0.1F) points.emplace_back(x + along, 0.9F, z);
  }
  return points;
}

NextScan next_scan(std::vector<Eigen::Vector3f> points) {
  return {shifted(Stamp{}, kPeriod), Surface(std::move(points)), Pose::Identity()};
}

std::optional<MotionToNext> measured(const NextScan& next) {
  return measure_to_next(vehicle(12), Stamp{}, next, {}, true);
}

TEST(MeasureToNext, a_step_of_which_nothing_was_known_is_found) {
  const auto motion = measured(next_scan(vehicle(13.2F)));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->step_m.x(), 1.2, 0.02);
  EXPECT_NEAR(motion->step_m.y(), 0, 0.02);
  EXPECT_DOUBLE_EQ(motion->dt, kPeriod);
  EXPECT_GT(evidence_of_motion(*motion), 100);
}

TEST(MeasureToNext, the_step_is_one_over_ground) {
  NextScan next = next_scan(vehicle(11));  // the ego has moved on by 1 m, the vehicle has not
  next.T_lidar_next_lidar_k = Eigen::Translation3d(-1, 0, 0) * Pose::Identity();
  const auto motion = measured(next);
  ASSERT_TRUE(motion);
  EXPECT_LT(motion->step_m.norm(), 0.02);
  EXPECT_LT(evidence_of_motion(*motion), 4);
}

TEST(MeasureToNext, a_scan_that_does_not_show_the_object_says_nothing) {
  EXPECT_FALSE(measured(next_scan(vehicle(40))));
}

TEST(ExpectOnTheWay, goes_at_constant_velocity_and_is_least_sure_where_nothing_ties_it) {
  MotionToNext motion;
  motion.dt = 0.4;
  motion.T_mov = Eigen::Translation3d(2, 0, 0) * Pose::Identity();
  motion.step_covariance = 1e-4 * Eigen::Matrix2d::Identity();
  const auto at = [&](double dt) { return expect_on_the_way(motion, dt, MotionPriorOptions()); };
  EXPECT_NEAR(at(0.1).T_mov.translation().x(), 0.5, 1e-9);
  EXPECT_GT(at(0.2).position_covariance(0, 0), 4 * at(0.4).position_covariance(0, 0));
  EXPECT_GT(at(0.2).position_covariance(0, 0), 4 * at(0.02).position_covariance(0, 0));
}

}  // namespace
}  // namespace lidar_upsampling
