// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::testing {

/// Dense near the sensor and thin far from it, up to `reach` metres away and 3 m high.
inline std::vector<Eigen::Vector3f> lidar_like_cloud(int count, unsigned seed, float reach = 60) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(0, 1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const float range = 4 + (reach - 4) * std::pow(any(random), 3.F);
    const float azimuth = 6.2831853F * any(random);
    points.emplace_back(range * std::cos(azimuth), range * std::sin(azimuth), 3 * any(random));
  }
  return points;
}

}  // namespace lidar_upsampling::testing
