// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/registered_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::vehicle;

std::optional<PlanarStep> measured(std::vector<Eigen::Vector3f> before,
                                   std::vector<Eigen::Vector3f> now) {
  const Surface surface_before(std::move(before)), surface_now(std::move(now));
  return registered_step({surface_before, surface_now}, Eigen::Matrix3d::Identity());
}

TEST(RegisteredStep, of_a_piece_of_a_rear_is_sure_ahead_but_not_sideways) {
  const auto step = measured(vehicle(12, 0, 0.5F), vehicle(12.2F, 0));
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->mean.x(), 0.2, 0.02);
  EXPECT_LT(std::sqrt(step->covariance(0, 0)), 0.05);
  EXPECT_GT(step->covariance(1, 1), 10 * step->covariance(0, 0));
}

/// Ten posts along y, 0.3 m apart.
std::vector<Eigen::Vector3f> row_of_posts() {
  std::vector<Eigen::Vector3f> points;
  for (int post = 0; post < 10; ++post)
    for (float z = -1; z < 0; z += 0.1F)
      points.emplace_back(20, 0.3F * static_cast<float>(post), z);
  return points;
}

TEST(RegisteredStep, of_what_repeats_is_not_sure_along_it_though_it_fits_best_where_it_is) {
  const auto step = measured(row_of_posts(), row_of_posts());
  ASSERT_TRUE(step);
  EXPECT_GT(std::sqrt(step->covariance(1, 1)), 0.3);
}

TEST(RegisteredStep, of_a_few_points_knows_little_of_how_good_it_is) {
  const auto many = vehicle(12, 4), few = evenly_thinned(many, 16);
  const auto by_many = measured(many, many), by_few = measured(few, few);
  ASSERT_TRUE(by_many && by_few);
  EXPECT_LT(by_few->degrees_of_freedom, 6);
  EXPECT_GT(by_many->degrees_of_freedom, 30);
  EXPECT_LT(by_many->degrees_of_freedom, 1000);
}

TEST(RegisteredStep, finds_a_view_that_shrinks_in_the_larger_one_before) {
  const auto step = measured(vehicle(12, 4), vehicle(12.3F, 0.5F));
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->mean.x(), 0.3, 0.03);
}

/// A car that crosses from right to left: its front at `y`, and `side` metres of its side.
std::vector<Eigen::Vector3f> crossing_car(float y, float side) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1.2F; z < 0; z += 0.3F) {
    for (float depth = 0; depth < 1.2F; depth += 0.2F)
      points.emplace_back(20 + depth, y - 0.1F * depth * depth, z);
    for (float along = 0.1F; along < side; along += 0.1F) points.emplace_back(20, y - along, z);
  }
  return points;
}

TEST(RegisteredStep, does_not_turn_a_corner_to_lie_along_a_side) {
  const Surface before(crossing_car(-5, 0)), now(crossing_car(-4, 1.8F));
  ObjectScans scans{before, now};
  scans.T_mov_guess = Eigen::Translation3d(-0.5, 0.7, 0) * Pose::Identity();
  scans.turn_sigma_rad = 0.03;
  const auto step = registered_step(scans, Eigen::Matrix3d::Identity());
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->mean.y(), 1, 0.1);
  EXPECT_NEAR(step->mean[2], 0, 0.1);
  scans.turn_sigma_rad = 0;
  const auto turned = registered_step(scans, Eigen::Matrix3d::Identity());
  EXPECT_TRUE(!turned || std::abs(turned->mean[2]) > 0.5) << "what the test is about";
}

TEST(RegisteredStep, knows_that_no_road_user_jumps_up) {
  auto now = vehicle(12, 2);
  for (auto& point : now) point.z() += 0.4F;
  const auto step = measured(vehicle(12, 2), now);
  EXPECT_TRUE(!step || step->mean.head<2>().norm() < 0.03) << step->mean;
}

}  // namespace
}  // namespace lidar_upsampling
