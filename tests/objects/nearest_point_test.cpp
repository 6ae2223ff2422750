// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/nearest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(PointIndex, keeps_to_the_limit_among_many_points_in_every_search) {
  constexpr float kLimit_m2 = 0.02F;
  std::mt19937 random(2);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i) points.push_back(any_place(random, 1));
  const PointIndex index(points);
  const Surface surface(points);
  int with_one = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f place = any_place(random, 1.2F);
    const auto by_hand = std::min_element(points.begin(), points.end(), [&](auto& a, auto& b) {
      return (a - place).squaredNorm() < (b - place).squaredNorm();
    });
    const bool is_near = (*by_hand - place).squaredNorm() < kLimit_m2;
    const int expected = is_near ? static_cast<int>(by_hand - points.begin()) : -1;
    with_one += is_near ? 1 : 0;
    ASSERT_EQ(index.nearest(place, kLimit_m2).index, expected);
    ASSERT_EQ(index.nearest_of_all(place, kLimit_m2).first.index, expected);
    ASSERT_EQ(surface.nearest(place, kLimit_m2).index, expected);
    ASSERT_EQ(surface.nearest_of_all(place, kLimit_m2).first.index, expected);
    std::vector<PointIndex::Neighbor> found;
    index.within(place, kLimit_m2, found);
    ASSERT_EQ(found.empty(), !is_near);
    for (const auto& neighbor : found) ASSERT_LT(neighbor.sq_distance, kLimit_m2);
  }
  EXPECT_GT(with_one, 50);
  EXPECT_LT(with_one, 450);
}

TEST(PointIndex, the_k_nearest_are_those_of_a_search_by_hand) {
  std::mt19937 random(3);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 300; ++i) points.push_back(any_place(random, 1));
  const PointIndex index(points);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3f place = any_place(random, 1.2F);
    std::vector<float> by_hand;
    for (const auto& point : points) by_hand.push_back((point - place).squaredNorm());
    std::sort(by_hand.begin(), by_hand.end());
    std::vector<PointIndex::Neighbor> found;
    index.nearest(place, 7, found);
    ASSERT_EQ(found.size(), 7U);
    for (std::size_t k = 0; k < found.size(); ++k)
      ASSERT_FLOAT_EQ(found[k].sq_distance, by_hand[k]);
  }
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
