// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief One laser of a spinning LiDAR: at elevation zero its beam would leave the z axis at
/// `origin_height` (lasers of one unit do not sit in one point: 0.2 m apart in an HDL-64).
struct BeamRow {
  float tan_elevation = 0;
  float origin_height = 0;  ///< metres, lidar frame
  int begin = 0, end = 0;   ///< its points in BeamPattern::order

  /// Where the beam is at a horizontal distance from the axis, metres.
  [[nodiscard]] float height_at(float distance) const {
    return origin_height + distance * tan_elevation;
  }
  [[nodiscard]] Eigen::Vector3f origin() const { return {0, 0, origin_height}; }
};

/// @brief The beams on which a spinning LiDAR measured.
struct BeamPattern {
  std::vector<BeamRow> rows;   ///< upwards
  std::vector<int> order;      ///< the scan's points by row, then azimuth
  std::vector<float> azimuth;  ///< of each point, in [0, 2 pi)
  float azimuth_pitch = 0;     ///< radians, median step along a row
  float scatter = 0;           ///< of points off their row's cone, in rows

  [[nodiscard]] int num_rows() const { return static_cast<int>(rows.size()); }
  /// @brief The lowest row whose beam passes above a place, num_rows() if none does.
  /// @param guess a row to start from.
  [[nodiscard]] int first_row_above(float distance, float height, int guess) const;
};

/// @return none if the scan has no rings, or they are not a spinning LiDAR's: fewer than 2 or more
/// than 256, or not a cone each.
[[nodiscard]] std::optional<BeamPattern> find_beam_pattern(const LidarScan& scan);

/// Neighbours of a measurement on its own row and others, the next one and the one after that; -1:
/// none near enough.
struct BeamNeighbours {
  std::array<int, 2> right{-1, -1};  ///< to smaller azimuth
  std::array<int, 2> left{-1, -1};
  std::array<int, 2> down{-1, -1};
  std::array<int, 2> up{-1, -1};
};

/// @brief For each point of the row, in the row's order.
[[nodiscard]] std::vector<BeamNeighbours> find_neighbours(const BeamPattern& pattern, int row);

}  // namespace lidar_upsampling
