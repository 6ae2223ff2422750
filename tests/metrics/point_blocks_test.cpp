// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/point_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "clouds.h"

namespace lidar_upsampling {
namespace {

TEST(PointBlocks, hold_every_point_once_whatever_the_number) {
  for (const int count : {0, 1, 31, 32, 33, 64, 100, 1000}) {
    auto points = testing::lidar_like_cloud(count, 1);
    std::vector<Eigen::Vector3f> found;
    for (const auto& block : make_point_blocks(points).blocks) {
      for (int i = 0; i < block.count; ++i) {
        found.push_back(block.point(i));
      }
    }
    const auto by_x = [](const auto& a, const auto& b) { return a.x() < b.x(); };
    std::sort(points.begin(), points.end(), by_x);
    std::sort(found.begin(), found.end(), by_x);
    EXPECT_EQ(found, points) << count;
  }
}

TEST(PointBlocks, are_no_farther_than_their_nearest_point) {
  const auto queries = testing::lidar_like_cloud(50, 2);
  const auto others = make_point_blocks(queries);
  const auto cloud = make_point_blocks(testing::lidar_like_cloud(500, 3));
  for (const auto& block : cloud.blocks) {
    for (const auto& query : queries) {
      EXPECT_LE(block.sq_distance(query), block.sq_distances(query).minCoeff());
    }
    for (const auto& other : others.blocks) {
      float nearest = std::numeric_limits<float>::infinity();
      for (int i = 0; i < other.count; ++i) {
        nearest = std::min(nearest, block.sq_distance(other.point(i)));
      }
      EXPECT_LE(block.sq_distance(other), nearest);
    }
  }
}

}  // namespace
}  // namespace lidar_upsampling
