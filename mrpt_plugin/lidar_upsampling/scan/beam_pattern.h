// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "lidar_upsampling/azimuth.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief The turn in equal columns, about two for each step of a row.
struct Columns {
  explicit Columns(float azimuth_pitch)
      : number(std::max(6, static_cast<int>(2 * kTurn / azimuth_pitch))),
        per_radian(static_cast<float>(number) / kTurn) {}

  /// Unwrapped: azimuths beyond a turn give columns beyond it.
  [[nodiscard]] int at(float azimuth) const {
    return static_cast<int>(azimuth * per_radian + static_cast<float>(number)) - number;
  }

  int number;
  float per_radian;
};

/// @brief One laser of a spinning LiDAR: at elevation zero its beam would leave the z axis at
/// `origin_height` (lasers of one unit do not sit in one point: 0.2 m apart in an HDL-64).
struct BeamRow {
  float tan_elevation = 0;
  float origin_height = 0;  ///< metres, lidar frame
  int begin = 0, end = 0;   ///< its points in BeamPattern::order

  [[nodiscard]] Eigen::Vector3f origin() const { return {0, 0, origin_height}; }
};

/// @brief The beams on which a spinning LiDAR measured.
struct BeamPattern {
  std::vector<BeamRow> rows;   ///< upwards
  std::vector<int> order;      ///< the scan's points by row, then azimuth
  std::vector<float> azimuth;  ///< of each of these, in [0, 2 pi)
  float azimuth_pitch = 0;     ///< radians, median step along a row
  float scatter = 0;           ///< of points off their row's cone, in rows

  [[nodiscard]] int num_rows() const { return static_cast<int>(rows.size()); }
};

/// @return none if the scan has no rings, or they are not a spinning LiDAR's: fewer than 2 or more
/// than 256, or not a cone each.
[[nodiscard]] std::optional<BeamPattern> find_beam_pattern(const LidarScan& scan);

enum Side { kRight, kLeft, kDown, kUp };  ///< right: to smaller azimuth

/// The next measurements on both sides of one on its own row, and on the rows below and above, by
/// side: positions in BeamPattern::order, -1: none near enough.
using BeamNeighbours = std::array<int, 4>;

/// @brief For each point of the row.
/// @param neighbours of all points in the pattern's order; the row's are set.
void find_neighbours(const BeamPattern& pattern, int row, std::vector<BeamNeighbours>& neighbours);

}  // namespace lidar_upsampling
