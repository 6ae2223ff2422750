// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/surface.h"

#include <gtest/gtest.h>

#include <random>

namespace lidar_upsampling {
namespace {

// A wall ahead whose ranges have noise, sampled every `column_m` and `ring_m`.
std::vector<Eigen::Vector3f> noisy_wall(float column_m, float ring_m, float sigma_m) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise;
  std::vector<Eigen::Vector3f> points;
  for (float y = -0.5F; y < 0.5F; y += column_m)
    for (float z = -0.5F; z < 0.5F; z += ring_m)
      points.emplace_back(5 + sigma_m * noise(random), y, z);
  return points;
}

TEST(Surface, finds_the_normal_of_a_wall_that_is_dense_against_its_noise) {
  const Surface wall(noisy_wall(0.02F, 0.02F, 0.01F));
  int along_view = 0;
  const int count = static_cast<int>(wall.points().size());
  for (int i = 0; i < count; ++i) along_view += std::abs(wall.normal(i).x()) > 0.9F ? 1 : 0;
  EXPECT_GT(along_view, 0.9 * count);
}

TEST(Surface, spacing_is_that_of_points_beside_each_other) {
  const Surface wall(noisy_wall(0.3F, 0.1F, 0));
  for (int i = 0; i < static_cast<int>(wall.points().size()); ++i)
    EXPECT_NEAR(wall.spacing(i), 0.3, 1e-4) << i;
}

TEST(Surface, spacing_of_columns_far_apart_is_not_that_of_the_points_above_each_other) {
  const Surface wall(noisy_wall(0.9F, 0.1F, 0));
  for (int i = 0; i < static_cast<int>(wall.points().size()); ++i)
    EXPECT_GT(wall.spacing(i), 0.35) << i;
}

TEST(Surface, spacing_of_a_pole_that_has_nothing_beside_it_is_no_less_than_its_points_reach) {
  std::vector<Eigen::Vector3f> pole;
  for (float z = -1; z < 1; z += 0.25F) pole.emplace_back(5, 0, z);
  EXPECT_NEAR(Surface(pole).spacing(3), 1, 1e-4);
}

}  // namespace
}  // namespace lidar_upsampling
