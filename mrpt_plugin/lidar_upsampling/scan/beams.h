// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/scan/beam_pattern.h"

namespace lidar_upsampling {

/// @brief A ray on which the sensor measures, whether or not something came back.
struct Beam {
  Eigen::Vector3f direction;  ///< of unit length; from the row's origin
  float azimuth = 0;          ///< in [0, 2 pi)
  int point = -1;             ///< of the scan, what came back; -1: nothing
  int right = -1, left = -1;  ///< the points around, where nothing came back
  float share = 0;            ///< of the way from `right` to `left`
};

/// @brief The beams of a row, in order of azimuth: one for each point, and more where a row has
/// gaps of several steps (sky, dark surfaces) in directions that other rows measure in.
/// @param seen the directions that the scan measures in, of seen_directions().
[[nodiscard]] std::vector<Beam> find_beams(const LidarScan& scan, const BeamPattern& pattern,
                                           int row, const std::vector<bool>& seen);

/// For each column, its first beam, and one number more: how many there are.
[[nodiscard]] std::vector<int> first_of_columns(const std::vector<Beam>& beams,
                                                const Columns& columns);

/// Whether the scan has points there, for each of many equal sectors of azimuth.
[[nodiscard]] std::vector<bool> seen_directions(const BeamPattern& pattern);

/// @brief Ring, column and time of a beam: its point's; in gaps, those that follow from the points
/// around. Columns grow with azimuth if `columns_to_left`.
struct BeamLabel {
  std::uint16_t ring = 0, column = 0;
  float time_s = 0;
};
[[nodiscard]] BeamLabel label_of(const Beam& beam, const LidarScan& scan, bool columns_to_left);

/// Whether columns grow with azimuth (counter-clockwise).
[[nodiscard]] bool columns_go_left(const LidarScan& scan, const BeamPattern& pattern);

}  // namespace lidar_upsampling
