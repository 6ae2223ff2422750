// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling::testing {

// The rear of a vehicle ahead at `x`, and its left side for `length` metres.
inline std::vector<Eigen::Vector3f> vehicle(float x, float length, float half_width = 0.9F) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1.2F; z < 0.3F; z += 0.15F) {
    for (float y = -half_width; y <= half_width; y += 0.1F) points.emplace_back(x, y, z);
    for (float along = 0.1F; along < length; along += 0.1F) points.emplace_back(x + along, 0.9F, z);
  }
  return points;
}

// A street of walls 30 m ahead and 15 m to the sides, with what stands in it.
inline SeenSpace street_with(const std::vector<Eigen::Vector3f>& object) {
  constexpr float kColumn = 0.0035F, kRing = 0.007F, kGap = 0.005F;
  std::vector<Eigen::Vector3f> points = object;
  for (float azimuth = -1; azimuth < 1; azimuth += kColumn)
    for (float tangent = -0.15F; tangent < 0.1F; tangent += kRing) {
      const float range = std::min(30 / std::cos(azimuth), 15 / std::abs(std::sin(azimuth)));
      const Eigen::Vector3f far(range * std::cos(azimuth), range * std::sin(azimuth),
                                range * tangent);
      const bool is_hidden = std::any_of(object.begin(), object.end(), [&](const auto& near) {
        return std::abs(std::atan2(near.y(), near.x()) - azimuth) < kGap &&
               std::abs(near.z() / near.template head<2>().norm() - tangent) < kRing;
      });
      if (!is_hidden) points.push_back(far);
    }
  return {points, 0.4};
}

/// What a scan meets all around.
/// @param range_of a direction that is 1 m level: level, m.
template <typename Range>
std::vector<Eigen::Vector3f> all_around(const Range& range_of) {
  std::vector<Eigen::Vector3f> points;
  for (double up_deg = -14; up_deg < 10; up_deg += 0.4)
    for (double azimuth_deg = -180; azimuth_deg < 180; azimuth_deg += 0.2) {
      const Eigen::Vector3d way(std::cos(azimuth_deg * kDegree), std::sin(azimuth_deg * kDegree),
                                std::tan(up_deg * kDegree));
      points.emplace_back((range_of(way) * way).template cast<float>());
    }
  return points;
}

/// A scan that meets a wall all around.
inline SeenSpace wall_at(double range_m) {
  return {all_around([&](const Eigen::Vector3d&) { return range_m; }), 0.4};
}

}  // namespace lidar_upsampling::testing
