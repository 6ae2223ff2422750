// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/free_space.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lidar_upsampling {
namespace {

/// Farthest ahead.
float front_of(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& ahead) {
  float front = -std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& point : points) front = std::max(front, ahead.dot(point));
  return front;
}

}  // namespace

bool ends_in_sight(const ObjectSight& object, const Eigen::Vector2d& ahead) {
  constexpr float kEnd_m = 0.3F;  // of the object, that counts as its end
  constexpr std::array<float, 3> kFurther_m{0.2F, 0.4F, 0.6F};  // a post hides half a metre
  const Eigen::Vector3f direction(static_cast<float>(ahead.x()), static_cast<float>(ahead.y()), 0);
  const float front = front_of(object.points, direction);
  int count = 0, hidden = 0;
  for (const Eigen::Vector3f& point : object.points) {
    if (direction.dot(point) < front - kEnd_m) continue;
    ++count;
    hidden += std::any_of(kFurther_m.begin(), kFurther_m.end(), [&](float further) {
      return object.seen.is_out_of_sight(point + further * direction);
    });
  }
  return 2 * hidden < count;
}

}  // namespace lidar_upsampling
