// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// What a sensor sees of a car of 4.4 m by 1.8 m that stands turned: a long side, and so many
/// points of an end.
std::vector<Eigen::Vector3f> two_sides(double yaw, int num_at_end) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.02F);
  const Eigen::Rotation2Df turn(static_cast<float>(yaw));
  std::vector<Eigen::Vector3f> points;
  const auto add = [&](float x, float y) {
    const Eigen::Vector2f place = turn * Eigen::Vector2f(x + noise(random), y + noise(random));
    points.emplace_back(12 + place.x(), 3 + place.y(), 0.F);
  };
  for (int i = 0; i < 60; ++i) add(4.4F * static_cast<float>(i) / 59, 0);
  for (int i = 0; i < num_at_end; ++i)
    add(0, 1.8F * static_cast<float>(i) / static_cast<float>(num_at_end));
  return points;
}

/// Directions are the same half a turn apart.
double difference_deg(double a, double b) {
  return std::abs(std::remainder(a - b, M_PI)) / kDegree;
}

TEST(Sides, lie_along_the_car_and_not_along_its_diagonal) {
  for (int degrees = -80; degrees <= 90; degrees += 10)
    for (const int num_at_end : {0, 8, 25}) {
      const double yaw = yaw_of_sides(two_sides(degrees * kDegree, num_at_end));
      EXPECT_LT(difference_deg(yaw, degrees * kDegree), 3) << degrees << ", " << num_at_end;
      EXPECT_GT(yaw, -M_PI / 2);
      EXPECT_LE(yaw, M_PI / 2);
    }
}

/// A car's end, 1.7 m wide, and so much of its side, at a place where the sensor at the origin sees
/// it from straight behind.
std::vector<Eigen::Vector3f> seen_from_behind(double yaw, float side_m) {
  const Eigen::Rotation2Df turn(static_cast<float>(yaw));
  std::vector<Eigen::Vector3f> points;
  const auto add = [&](float x, float y) {
    const Eigen::Vector2f place = turn * Eigen::Vector2f(30 + x, y);
    points.emplace_back(place.x(), place.y(), 0.F);
  };
  for (int i = 0; i < 8; ++i) add(0, 1.7F * static_cast<float>(i) / 7);
  for (int i = 1; i < 4; ++i) add(side_m * static_cast<float>(i) / 3, 0);
  return points;
}

TEST(Sides, of_a_car_of_which_only_the_end_is_seen_lie_along_the_line_of_sight) {
  for (int degrees = -80; degrees <= 90; degrees += 10)
    for (const float side_m : {0.F, 0.5F, 1.5F})
      EXPECT_LT(difference_deg(yaw_of_sides(seen_from_behind(degrees * kDegree, side_m)),
                               degrees * kDegree),
                5)
          << degrees << ", " << side_m;
}

TEST(Sides, a_single_point_has_some) {
  EXPECT_TRUE(std::isfinite(yaw_of_sides({Eigen::Vector3f(1, 2, 3)})));
}

}  // namespace
}  // namespace lidar_upsampling
