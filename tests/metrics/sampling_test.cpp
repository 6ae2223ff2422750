// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace lidar_upsampling {
namespace {

/// Which points of a cloud of so many are drawn.
std::vector<int> sample_indices(int num_points, std::size_t count, std::uint64_t seed) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < num_points; ++i) points.emplace_back(static_cast<float>(i), 0, 0);
  std::vector<int> indices;
  for (const auto& point : sample_points(points, count, seed))
    indices.push_back(static_cast<int>(point.x()));
  return indices;
}

TEST(Sampling, draws_without_replacement_from_a_large_cloud) {
  const auto indices = sample_indices(1000, 600, 1);
  EXPECT_EQ(indices.size(), 600U);
  EXPECT_EQ(std::set<int>(indices.begin(), indices.end()).size(), 600U);
  EXPECT_GE(*std::min_element(indices.begin(), indices.end()), 0);
  EXPECT_LT(*std::max_element(indices.begin(), indices.end()), 1000);
}

TEST(Sampling, keeps_every_point_of_a_small_cloud_and_repeats_some) {
  const auto indices = sample_indices(300, 1000, 1);
  EXPECT_EQ(indices.size(), 1000U);
  EXPECT_EQ(std::set<int>(indices.begin(), indices.begin() + 300).size(), 300U);
  // 700 draws of 300 with replacement hit 271 of them, give or take 5.
  EXPECT_NEAR(static_cast<double>(std::set<int>(indices.begin() + 300, indices.end()).size()), 271,
              25);
}

TEST(Sampling, every_point_is_as_likely_as_any_other) {
  std::vector<int> hits(10, 0);
  for (int seed = 0; seed < 4000; ++seed) {
    for (const int i : sample_indices(10, 3, seed)) {
      ++hits[i];
    }
  }
  for (const int count : hits) {
    EXPECT_NEAR(count, 1200, 5 * 29);  // 5 sigma of a binomial
  }
}

TEST(Sampling, is_the_same_on_every_machine_and_another_with_another_seed) {
  EXPECT_EQ(sample_indices(100, 6, 7), (std::vector<int>{15, 52, 94, 7, 65, 28}));
  EXPECT_EQ(sample_indices(3, 6, 7), (std::vector<int>{0, 1, 2, 0, 1, 0}));
  EXPECT_NE(sample_indices(100, 6, 7), sample_indices(100, 6, 8));
}

TEST(Sampling, refuses_to_fill_up_an_empty_cloud) {
  EXPECT_THROW(static_cast<void>(sample_indices(0, 5, 1)), std::invalid_argument);
  EXPECT_TRUE(sample_indices(0, 0, 1).empty());
}

}  // namespace
}  // namespace lidar_upsampling
