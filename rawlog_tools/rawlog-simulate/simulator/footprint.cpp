// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/footprint.h"

#include <array>
#include <cmath>

namespace lidar_upsampling::sim {

namespace {

struct Rectangle {
  Eigen::Vector2d center, along, across;  ///< the latter from the middle to the sides
};

Rectangle rectangle_at(const Footprint& footprint, double t, double grown) {
  const MotionState state = state_at(footprint.motion, t);
  const Eigen::Vector2d ahead(std::cos(state.yaw), std::sin(state.yaw));
  return {{state.x, state.y},
          (0.5 * footprint.length + grown) * ahead,
          (0.5 * footprint.width + grown) * Eigen::Vector2d(-ahead.y(), ahead.x())};
}

// Rectangles are apart if they are so along a side of either.
bool touch(const Rectangle& a, const Rectangle& b) {
  const Eigen::Vector2d between = b.center - a.center;
  const std::array<Eigen::Vector2d, 4> sides{a.along, a.across, b.along, b.across};
  for (const Eigen::Vector2d& side : sides) {
    double reach = 0;
    for (const Eigen::Vector2d& half : sides) reach += std::abs(half.dot(side));
    if (std::abs(between.dot(side)) > reach) return false;
  }
  return true;
}

}  // namespace

Footprint footprint_of(const Object& object) {
  return {object.shape.length, object.shape.width, object.motion};
}

Footprint ego_footprint(const EgoSpec& ego) { return {4.4, 1.85, ego.motion}; }

bool ever_touch(const Footprint& a, const Footprint& b, double until_s, double gap_m) {
  constexpr double kStep = 0.05;
  for (int i = 0; i * kStep < until_s + kStep; ++i) {
    if (touch(rectangle_at(a, i * kStep, gap_m), rectangle_at(b, i * kStep, 0))) return true;
  }
  return false;
}

}  // namespace lidar_upsampling::sim
