// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/hidden_foot.h"

#include <algorithm>
#include <limits>

namespace lidar_upsampling {
namespace {

/// Directions below a cluster as the sensor sees them: tangents against the vertical plane through
/// its middle and against the horizontal.
struct Window {
  Eigen::Vector2f ahead;            ///< unit, towards the middle
  float left = 0, right = 0;        ///< of the azimuth
  float foot = 0, lowest = 0;       ///< of the elevation
  float nearest = 0, farthest = 0;  ///< m, horizontal range of the cluster
};

float across(const Eigen::Vector2f& ahead, const Eigen::Vector3f& point) {
  return (ahead.x() * point.y() - ahead.y() * point.x()) / ahead.dot(point.head<2>());
}

Window window_below(const LidarScan& scan, const Ground& ground, const std::vector<int>& cluster) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float height = 0;
  for (const int i : cluster) {
    sum += scan.points[i];
    height += ground.height[i];
  }
  const auto count = static_cast<float>(cluster.size());
  const Eigen::Vector3f foot = sum / count - height / count * ground.plane.normal.cast<float>();
  Window window{foot.head<2>().normalized(), -kFar, kFar, 0, kFar, kFar, 0};
  window.foot = foot.z() / foot.head<2>().norm();
  for (const int i : cluster) {
    const Eigen::Vector3f& point = scan.points[i];
    const float range = point.head<2>().norm();
    const float side = across(window.ahead, point);
    window.left = std::max(window.left, side);
    window.right = std::min(window.right, side);
    window.lowest = std::min(window.lowest, point.z() / range);
    window.nearest = std::min(window.nearest, range);
    window.farthest = std::max(window.farthest, range);
  }
  return window;
}

}  // namespace

bool foot_is_hidden(const LidarScan& scan, const Ground& ground, const std::vector<int>& cluster) {
  constexpr float kMargin = 0.5F;  // m, what is as far away is part of it
  constexpr int kHiddenPerSeen = 3;
  const Window window = window_below(scan, ground, cluster);
  int num_hidden = 0;
  int num_seen = 0;
  for (const Eigen::Vector3f& point : scan.points) {
    const float range_ahead = window.ahead.dot(point.head<2>());
    if (range_ahead <= 0) continue;
    const float side = across(window.ahead, point);
    if (side > window.left || side < window.right) continue;
    const float range = point.head<2>().norm();
    const float slope = point.z() / range;
    if (slope <= window.foot || slope >= window.lowest) continue;
    num_hidden += static_cast<int>(range < window.nearest - kMargin);
    num_seen += static_cast<int>(range > window.farthest + kMargin);
  }
  return num_hidden > kHiddenPerSeen * num_seen;
}

}  // namespace lidar_upsampling
