// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/free_space.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lidar_upsampling {
namespace {

struct Extent {
  float front = -std::numeric_limits<float>::infinity();     ///< farthest ahead
  float nearest_m = std::numeric_limits<float>::infinity();  ///< from the sensor
};

Extent extent_of(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& ahead) {
  Extent extent;
  for (const Eigen::Vector3f& point : points) {
    extent.front = std::max(extent.front, ahead.dot(point));
    extent.nearest_m = std::min(extent.nearest_m, point.norm());
  }
  return extent;
}

}  // namespace

bool ends_in_sight(const ObjectSight& object, const Eigen::Vector2d& ahead) {
  constexpr float kEnd_m = 0.3F;  // of the object, that counts as its end
  constexpr std::array<float, 3> kFurther_m{0.2F, 0.4F, 0.6F};  // a post hides half a metre
  const Eigen::Vector3f direction(static_cast<float>(ahead.x()), static_cast<float>(ahead.y()), 0);
  const float front = extent_of(object.points, direction).front;
  int count = 0, hidden = 0;
  for (const Eigen::Vector3f& point : object.points) {
    if (direction.dot(point) < front - kEnd_m) continue;
    ++count;
    hidden += std::any_of(kFurther_m.begin(), kFurther_m.end(), [&](float further) {
      return object.seen.is_behind_something(point + further * direction);
    });
  }
  return 2 * hidden < count;
}

bool was_there_then(const ObjectSight& object, const Eigen::Vector2d& step,
                    const Pose& T_other_lidar, const SeenSpace& other) {
  constexpr double kTelling_m = 0.7;  // what SeenSpace can tell a place from its surroundings by
  constexpr int kFewest = 3;
  constexpr double kLeastShare = 0.15;
  if (step.norm() < kTelling_m) return false;
  const Eigen::Vector3f ahead(static_cast<float>(step.x()), static_cast<float>(step.y()), 0);
  const Eigen::Isometry3f T = T_other_lidar.cast<float>();
  const Extent extent = extent_of(object.points, ahead);
  int telling = 0, gone = 0;
  for (const Eigen::Vector3f& point : object.points) {
    const Eigen::Vector3f further = point + ahead;
    const Sight beyond = object.seen.at(further), then = other.at(T * point);
    const bool is_end =
        beyond == Sight::seen_through ||
        (beyond == Sight::open && ahead.dot(point) > extent.front - ahead.squaredNorm());
    const bool is_behind_itself =
        beyond == Sight::hidden && object.seen.reach(further) > extent.nearest_m;
    const bool tells = is_behind_itself || (is_end && then != Sight::hidden);
    telling += tells ? 1 : 0;
    gone += tells && then != Sight::open ? 1 : 0;
  }
  const int fewest = std::max(kFewest, static_cast<int>(object.points.size()) / 5);
  return telling >= fewest && gone < kLeastShare * telling;
}

}  // namespace lidar_upsampling
