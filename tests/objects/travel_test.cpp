// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/travel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lidar_upsampling {
namespace {

const Eigen::Matrix2d kI = Eigen::Matrix2d::Identity();
const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

KnownMotion measured(double vx, double sigma) {
  KnownMotion known;
  known.velocity_at_rest.x() = vx;
  known.velocity_covariance = sigma * sigma * kI;
  return known;
}

Travel travel_at(double vx, double sigma) {
  return expect_travel(measured(vx, sigma), Stamp{}, kLevel, MotionPriorOptions());
}

TEST(Travel, of_an_object_never_seen_may_lead_anywhere) {
  const MotionPriorOptions options;
  const LevelGaussian step = step_at(expect_travel({}, Stamp{}, kLevel, options), 0.1);
  EXPECT_EQ(step.mean, Eigen::Vector2d::Zero());
  EXPECT_NEAR(std::sqrt(step.covariance(0, 0)), 0.1 * options.unknown_speed_sigma, 0.02);
}

TEST(Travel, is_the_less_certain_the_older_what_is_known) {
  const auto spread = [](double age) {
    const Travel travel =
        expect_travel(measured(10, 0.1), shifted(Stamp{}, age), kLevel, MotionPriorOptions());
    return step_at(travel, 0.1).covariance(0, 0);
  };
  EXPECT_GT(spread(0.5), 4 * spread(0.1));
}

TEST(Travel, a_velocity_and_a_step_tell_how_hard_it_brakes) {
  const Travel travel = having_seen(travel_at(10, 0.01), {{1.88, 0}, 1e-6 * kI}, 0.2);
  EXPECT_NEAR(travel.mean[2], -6, 0.3);
  EXPECT_NEAR(step_at(travel, 0.1).mean.x(), 0.97, 0.003);  // ahead of half the step
  EXPECT_NEAR(velocity_at(travel, 0.2).mean.x(), 8.8, 0.1);
}

TEST(Travel, keeps_to_what_is_known_where_a_step_is_loose) {
  Eigen::Matrix2d loose = 1e-4 * kI;
  loose(0, 0) = 1;  // it slides along its own side
  const Travel travel = having_seen(travel_at(10, 0.5), {{0, 0.2}, loose}, 0.1);
  const LevelGaussian step = step_at(travel, 0.1);
  EXPECT_NEAR(step.mean.x(), 1, 0.02);
  EXPECT_NEAR(step.mean.y(), 0.2, 0.05);
  EXPECT_LT(step.covariance(1, 1), 0.1 * step.covariance(0, 0));
}

TEST(Travel, accelerations_fade) {
  Travel travel = travel_at(10, 0.1);
  travel.mean[2] = -4;
  const Travel soon = later(travel, 0.1, MotionPriorOptions());
  EXPECT_NEAR(soon.mean[0], 9.6, 1e-9);
  EXPECT_LT(soon.mean[2], -3.5);
  EXPECT_GT(later(travel, 3, MotionPriorOptions()).mean[2], -0.3);
}

TEST(Travel, as_known_at_a_scan_goes_on_from_there) {
  KnownMotion known = measured(0, 0.1);
  known.travel = having_seen(travel_at(10, 0.1), {{1.88, 0}, 1e-6 * kI}, 0.2);
  const Eigen::Matrix3d quarter =
      Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Travel travel = expect_travel(known, Stamp{}, quarter, MotionPriorOptions());
  EXPECT_NEAR(travel.mean[0], 0, 1e-9);
  EXPECT_NEAR(travel.mean[1], known.travel->mean[0], 1e-9);
  EXPECT_LT(travel.mean[3], -3);
}

TEST(Disagreement, is_one_of_two_standard_deviations_squared) {
  EXPECT_NEAR(disagreement({{2, 0}, 0.5 * kI}, {{0, 0}, 0.5 * kI}), 4, 1e-12);
}

}  // namespace
}  // namespace lidar_upsampling
