// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

constexpr float kTurn = 2 * static_cast<float>(M_PI);

/// @brief The azimuth of a place, in [0, 2 pi), to 1e-5: several times as fast as std::atan2.
/// Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.49.
[[nodiscard]] inline float azimuth_of(float x, float y) {
  const float wide = std::abs(x), high = std::abs(y);
  const float t = std::min(wide, high) / std::max(std::max(wide, high), 1e-30F), s = t * t;
  float angle =
      t * (0.9998660F + s * (-0.3302995F + s * (0.1801410F + s * (-0.0851330F + s * 0.0208351F))));
  if (high > wide) angle = kTurn / 4 - angle;
  if (x < 0) angle = kTurn / 2 - angle;
  if (y < 0) angle = kTurn - angle;
  return angle < kTurn ? angle : 0;
}

/// @brief How high a place lies above the horizon, in [-pi / 2, pi / 2], as exactly.
[[nodiscard]] inline float elevation_of(float level_distance, float z) {
  const float angle = azimuth_of(level_distance, std::abs(z));
  return z < 0 ? -angle : angle;
}

/// @brief The tangent of a place's azimuth, to the left of a direction.
/// @param ahead unit vector, level; the place lies on its side.
[[nodiscard]] inline float tangent_from(const Eigen::Vector2f& ahead,
                                        const Eigen::Vector3f& place) {
  return (ahead.x() * place.y() - ahead.y() * place.x()) / ahead.dot(place.head<2>());
}

}  // namespace lidar_upsampling
