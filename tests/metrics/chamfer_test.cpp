// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/chamfer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>

#include "clouds.h"

namespace lidar_upsampling {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points random_points(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(-5, 5);
  Points points;
  for (int i = 0; i < count; ++i) {
    const float x = any(random), y = any(random);
    points.emplace_back(x, y, any(random));
  }
  return points;
}

double brute_force_mean(const Points& from, const Points& to, bool squared = false) {
  double sum = 0;
  for (const auto& p : from) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& q : to) {
      best = std::min(best, (p.cast<double>() - q.cast<double>()).squaredNorm());
    }
    sum += squared ? best : std::sqrt(best);
  }
  return sum / static_cast<double>(from.size());
}

TEST(Chamfer, of_a_cloud_with_itself_is_zero) {
  const Points points = random_points(500, 1);
  const Chamfer chamfer = compute_chamfer(points, points);
  EXPECT_EQ(chamfer.mean_m(), 0);
  EXPECT_EQ(chamfer.sum_sq_m2(), 0);
}

TEST(Chamfer, agrees_with_figures_made_by_hand) {
  // 0 -> 3 and 1 -> 2 away; back, 3 -> 2 away.
  const Chamfer chamfer = compute_chamfer({{0, 0, 0}, {1, 0, 0}}, {{3, 0, 0}});
  EXPECT_DOUBLE_EQ(chamfer.forward_m, 2.5);
  EXPECT_DOUBLE_EQ(chamfer.backward_m, 2);
  EXPECT_DOUBLE_EQ(chamfer.forward_sq_m2, 6.5);
  EXPECT_DOUBLE_EQ(chamfer.backward_sq_m2, 4);
  EXPECT_DOUBLE_EQ(chamfer.mean_m(), 2.25);
  EXPECT_DOUBLE_EQ(chamfer.sum_sq_m2(), 10.5);
}

TEST(Chamfer, agrees_with_brute_force) {
  const Points first = random_points(700, 2), second = random_points(400, 3);
  const Chamfer chamfer = compute_chamfer(first, second);
  EXPECT_NEAR(chamfer.forward_m, brute_force_mean(first, second), 1e-5);
  EXPECT_NEAR(chamfer.backward_m, brute_force_mean(second, first), 1e-5);
}

TEST(Chamfer, agrees_with_brute_force_on_clouds_like_a_scanners) {
  Points first = testing::lidar_like_cloud(3000, 4);
  const Points second = testing::lidar_like_cloud(2500, 5, 80);
  first.insert(first.end(), second.begin(), second.begin() + 200);  // and some on top of each other
  const Chamfer chamfer = compute_chamfer(first, second);
  EXPECT_NEAR(chamfer.forward_m, brute_force_mean(first, second), 1e-6);
  EXPECT_NEAR(chamfer.backward_m, brute_force_mean(second, first), 1e-6);
  EXPECT_NEAR(chamfer.forward_sq_m2, brute_force_mean(first, second, true), 1e-5);
  EXPECT_NEAR(chamfer.backward_sq_m2, brute_force_mean(second, first, true), 1e-5);
}

TEST(Chamfer, does_not_depend_on_the_number_of_threads) {
  const Points first = random_points(5000, 4), second = random_points(5000, 5);
  const Chamfer parallel = compute_chamfer(first, second);
  const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(compute_chamfer(first, second).sum_sq_m2(), parallel.sum_sq_m2());
}

TEST(Chamfer, an_empty_cloud_is_refused) {
  EXPECT_THROW(static_cast<void>(compute_chamfer({}, {{0, 0, 0}})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(compute_chamfer({{0, 0, 0}}, {})), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
