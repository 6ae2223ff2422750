// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::sim {

/// From `t` seconds on (until the next phase), constant acceleration and rate of turn.
struct MotionPhase {
  double t = 0;
  double acceleration = 0;  ///< m/s^2, along the heading
  double yaw_rate = 0;      ///< rad/s while rolling; a vehicle that stands does not turn
};

/// How something drives over flat ground. Braking ends at a standstill, never in reverse.
struct MotionProfile {
  double x = 0, y = 0, yaw = 0;  ///< at t = 0, world frame
  double z = 0;                  ///< of the ground it stands on
  double speed = 0;              ///< m/s at t = 0, >= 0
  std::vector<MotionPhase> phases;
};

struct MotionState {
  double x = 0, y = 0, yaw = 0;
  double z = 0;
  double speed = 0;
  double yaw_rate = 0;

  [[nodiscard]] Eigen::Vector3d velocity() const {
    return {speed * std::cos(yaw), speed * std::sin(yaw), 0};
  }
  /// T_world_object.
  [[nodiscard]] Pose pose() const;
};

/// The exact state (closed form, no integration steps) `t` seconds after the start, t >= 0.
[[nodiscard]] MotionState state_at(const MotionProfile& profile, double t);

/// @brief Phases from their names (`constant`, `brake`, `accelerate`, `turn_left`, `turn_right`) or
/// from a list of "t acceleration yaw_rate_deg" separated by ';'.
/// @throw std::invalid_argument naming what cannot be read.
[[nodiscard]] std::vector<MotionPhase> parse_phases(const std::string& text);

}  // namespace lidar_upsampling::sim
