// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/free_space.h"

#include <gtest/gtest.h>

#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::street_with;

// A wall to the left that two posts let a piece of be seen.
TEST(EndsInSight, is_not_said_of_a_wall_that_a_post_hides_the_rest_of) {
  std::vector<Eigen::Vector3f> wall, all;
  for (float x = 11; x < 12; x += 0.04F)
    for (float z = -1; z < 0.5F; z += 0.1F) wall.emplace_back(x, 6, z);
  all = wall;
  const auto add_post = [&](float azimuth) {
    for (float a = azimuth - 0.02F; a < azimuth + 0.02F; a += 0.003F)
      for (float z = -0.8F; z < 0.5F; z += 0.03F)
        all.emplace_back(8 * std::cos(a), 8 * std::sin(a), z);
  };
  add_post(std::atan2(6.F, 12.05F) - 0.02F);
  const SeenSpace seen = street_with(all);
  EXPECT_FALSE(ends_in_sight({wall, seen}, {1, 0}));
  EXPECT_TRUE(ends_in_sight({wall, seen}, {-1, 0}));
}

}  // namespace
}  // namespace lidar_upsampling
