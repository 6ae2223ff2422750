// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/registered_step.h"

#include <gtest/gtest.h>

#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::vehicle;

std::optional<PlanarStep> measured(std::vector<Eigen::Vector3f> before,
                                   std::vector<Eigen::Vector3f> now) {
  ObjectScans scans;
  scans.before = std::move(before);
  scans.now = std::move(now);
  return registered_step(scans, Eigen::Matrix3d::Identity());
}

TEST(RegisteredStep, of_a_piece_of_a_rear_is_sure_ahead_but_not_sideways) {
  const auto step = measured(vehicle(12, 0, 0.5F), vehicle(12.2F, 0));
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->mean.x(), 0.2, 0.02);
  EXPECT_LT(std::sqrt(step->covariance(0, 0)), 0.05);
  EXPECT_GT(step->covariance(1, 1), 10 * step->covariance(0, 0));
}

TEST(RegisteredStep, finds_a_view_that_shrinks_in_the_larger_one_before) {
  const auto step = measured(vehicle(12, 4), vehicle(12.3F, 0.5F));
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->mean.x(), 0.3, 0.03);
}

TEST(RegisteredStep, knows_that_no_road_user_jumps_up) {
  auto now = vehicle(12, 2);
  for (auto& point : now) point.z() += 0.4F;
  const auto step = measured(vehicle(12, 2), now);
  EXPECT_TRUE(!step || step->mean.head<2>().norm() < 0.03) << step->mean;
}

}  // namespace
}  // namespace lidar_upsampling
