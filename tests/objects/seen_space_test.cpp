// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/seen_space.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lidar_upsampling {
namespace {

// A wall at 20 m ahead, from 10 degrees to the right to 10 to the left, seen by rings a degree
// apart.
SeenSpace wall() {
  std::vector<Eigen::Vector3f> points;
  for (float elevation = -0.2F; elevation < 0.2F; elevation += 0.0175F)
    for (float azimuth = -0.175F; azimuth < 0.175F; azimuth += 0.0035F)
      points.emplace_back(20, 20 * std::tan(azimuth), 20 * std::tan(elevation));
  return {points, 1};
}

TEST(SeenSpace, what_lies_behind_a_surface_is_hidden) {
  EXPECT_EQ(wall().at({25, 1, 0.3F}), Sight::hidden);
}

TEST(SeenSpace, beams_have_passed_what_lies_before_a_surface) {
  EXPECT_EQ(wall().at({15, -1, 0.4F}), Sight::seen_through);
}

TEST(SeenSpace, the_surface_itself_is_open) { EXPECT_EQ(wall().at({20.2F, 2, 1}), Sight::open); }

TEST(SeenSpace, nothing_is_known_where_no_beam_went) {
  EXPECT_EQ(wall().at({20, 0, 6}), Sight::open);
  EXPECT_EQ(wall().at({0.1F, 0, 30}), Sight::open);
  EXPECT_EQ(SeenSpace({}, 1).at({10, 10, 0}), Sight::open);
}

TEST(SeenSpace, where_the_sensor_does_not_look_all_is_out_of_sight) {
  EXPECT_EQ(wall().at({10, 10, 0}), Sight::hidden);
  EXPECT_EQ(wall().at({-25, 0, 0}), Sight::hidden);
  EXPECT_TRUE(wall().is_out_of_sight({10, 10, 0}));
  EXPECT_FALSE(wall().is_out_of_sight({10, 1, 0}));
}

TEST(SeenSpace, a_few_beams_without_an_echo_are_no_end_of_the_view) {
  std::vector<Eigen::Vector3f> points;
  for (float azimuth = -1; azimuth < 1; azimuth += 0.0035F)
    if (std::abs(azimuth) > 0.05F)
      points.emplace_back(10 * std::cos(azimuth), 10 * std::sin(azimuth), 0);
  const SeenSpace seen(points, 1);
  EXPECT_EQ(seen.at({5, 0, 0}), Sight::open);
  EXPECT_FALSE(seen.is_out_of_sight({20, 0, 0}));
}

TEST(SeenSpace, beside_an_edge_beams_disagree_and_tell_nothing) {
  std::vector<Eigen::Vector3f> points;
  for (float azimuth = -0.175F; azimuth < 0.175F; azimuth += 0.0035F) {
    const float range = azimuth < 0 ? 10 : 30;
    points.emplace_back(range * std::cos(azimuth), range * std::sin(azimuth), 0);
  }
  const SeenSpace seen(points, 1);
  EXPECT_EQ(seen.at({20, 0, 0}), Sight::open);
  EXPECT_EQ(seen.at({20, -1, 0}), Sight::hidden);
  EXPECT_EQ(seen.at({20, 1, 0}), Sight::seen_through);
}

}  // namespace
}  // namespace lidar_upsampling
