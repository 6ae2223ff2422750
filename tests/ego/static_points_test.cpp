// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/static_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace lidar_upsampling {
namespace {

constexpr int kWidth = 480, kHeight = 160;

/// A point every four pixels.
std::vector<ProjectedPoint> dense_points() {
  std::vector<ProjectedPoint> points;
  for (int v = 2; v < kHeight; v += 4) {
    for (int u = 2; u < kWidth; u += 4) {
      points.push_back(
          {static_cast<int>(points.size()), static_cast<float>(u), static_cast<float>(v), 20});
    }
  }
  return points;
}

cv::Mat even_texture() { return {kHeight, kWidth, CV_32FC1, cv::Scalar(0.01)}; }

TEST(StaticPoints, are_spread_over_the_whole_picture) {
  const auto points = dense_points();
  const std::vector<std::uint8_t> none(points.size(), 0);
  const auto chosen = choose_static_points({points, none, none, {kWidth, kHeight}, even_texture()});
  EXPECT_LE(chosen.size(), 300U);
  std::set<std::pair<int, int>> cells;
  for (const int i : chosen) {
    cells.emplace(static_cast<int>(points[i].u / 20), static_cast<int>(points[i].v / 20));
  }
  EXPECT_EQ(cells.size(), 24U * 8U);
}

TEST(StaticPoints, keep_away_from_objects_and_unreliable_points) {
  const auto points = dense_points();
  std::vector<std::uint8_t> unreliable(points.size(), 0), candidate(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    unreliable[i] = points[i].u < 100;
    candidate[i] = points[i].u > 200 && points[i].u < 300;
  }
  const auto chosen =
      choose_static_points({points, unreliable, candidate, {kWidth, kHeight}, even_texture()});
  ASSERT_FALSE(chosen.empty());
  for (const int i : chosen) {
    EXPECT_GE(points[i].u, 100);
    EXPECT_TRUE(points[i].u < 200 - 4 || points[i].u > 300 + 4) << points[i].u;
  }
}

TEST(StaticPoints, prefer_texture) {
  const auto points = dense_points();
  cv::Mat texture(kHeight, kWidth, CV_32FC1, cv::Scalar(0));
  texture.colRange(240, kWidth) = 0.01;
  texture.at<float>(50, 302) = 1;
  const std::vector<std::uint8_t> none(points.size(), 0);
  const auto chosen = choose_static_points({points, none, none, {kWidth, kHeight}, texture});
  EXPECT_TRUE(std::all_of(chosen.begin(), chosen.end(), [&](int i) { return points[i].u >= 240; }));
  EXPECT_TRUE(std::any_of(chosen.begin(), chosen.end(),
                          [&](int i) { return points[i].u == 302 && points[i].v == 50; }));
}

}  // namespace
}  // namespace lidar_upsampling
