// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/nearest_point.h"

#include <gtest/gtest.h>

#include <random>

namespace lidar_upsampling {
namespace {

Eigen::Vector3f any_place(std::mt19937& random, float reach) {
  std::uniform_real_distribution<float> coordinate(-reach, reach);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

Surface any_surface(std::mt19937& random) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 300; ++i) points.push_back(any_place(random, 1));
  return Surface(std::move(points));
}

TEST(PointIndex, finds_nothing_beyond_the_limit) {
  const PointIndex index({{0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(index.nearest({1.3F, 0, 0}, 0.1F).index, 1);
  EXPECT_EQ(index.nearest({1.4F, 0, 0}, 0.1F).index, -1);
  EXPECT_EQ(index.nearest_of_all({1.4F, 0, 0}, 0.1F).first.index, -1);
  std::vector<PointIndex::Neighbor> found;
  index.within({0.4F, 0, 0}, 0.2F, found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().index, 0);
}

TEST(PointIndex, tells_how_far_all_others_are_at_least) {
  const PointIndex index({{0, 0, 0}, {1, 0, 0}, {0, 3, 0}});
  const auto near_first = index.nearest_of_all({0.2F, 0, 0}, 4);
  EXPECT_EQ(near_first.first.index, 0);
  EXPECT_FLOAT_EQ(near_first.sq_others, 0.64F);
  EXPECT_FLOAT_EQ(index.nearest_of_all({0.2F, 0, 0}, 0.3F).sq_others, 0.3F);  // as far as it looked
}

TEST(NearestPoint, is_what_a_search_finds_however_the_point_goes) {
  constexpr float kReach_m = 0.3F;
  std::mt19937 random(1);
  const Surface surface = any_surface(random);
  int kept = 0;
  for (int walk = 0; walk < 100; ++walk) {
    Eigen::Vector3f place = any_place(random, 1.3F);
    NearestPoint nearest;
    for (float step_m = 0.3F; step_m > 1e-3F; step_m *= 0.7F) {
      look_up(surface, place, kReach_m, nearest);
      ASSERT_EQ(nearest.index, surface.nearest(place, kReach_m * kReach_m).index);
      kept += nearest.asked != place ? 1 : 0;
      place += step_m * any_place(random, 1).normalized();
    }
  }
  EXPECT_GT(kept, 300);  // of 1700 without a search
}

}  // namespace
}  // namespace lidar_upsampling
