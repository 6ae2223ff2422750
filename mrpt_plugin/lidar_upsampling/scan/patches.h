// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "lidar_upsampling/scan/beam_pattern.h"

namespace lidar_upsampling {

/// @brief The piece of surface that one measured point stands for: flat, and as large as the cell
/// of its beam, half-way to the beams around.
struct Patch {
  Eigen::Vector3f origin;       ///< of the beam
  Eigen::Matrix3f axes;         ///< columns: along the beam, to the left, upwards
  Eigen::Vector3f slope;        ///< n with n . (p - origin) = 1 for its points p
  float right, left, down, up;  ///< reach as seen from the origin: tangents of the angles
};

/// When neighbouring points are of one surface.
struct PatchOptions {
  double max_step_m = 0.15;          ///< difference in range, where there is nothing else to go by
  double max_step_per_range = 0.01;  ///< added per metre from the sensor
  double max_bend_m = 0.1;           ///< deviation from straight over three beams
  double max_bend_per_range = 0.02;  ///< added per metre from the sensor
};

/// @brief Makes the patches of a scan's points. Their slopes lead to the neighbours of the same
/// surface, so never over a depth edge; where a point has none, its patch faces the sensor.
class PatchMaker {
 public:
  /// Both must outlive the maker.
  PatchMaker(const LidarScan& scan, const BeamPattern& pattern, const PatchOptions& options);

  /// @param owner of each point; neighbours of another owner are another surface.
  [[nodiscard]] Patch make(int point, const std::vector<int>& owner) const;

  /// @brief Of all points.
  [[nodiscard]] std::vector<Patch> make_all(const std::vector<int>& owner) const;

  /// The points whose patches may lead to this point.
  [[nodiscard]] const BeamNeighbours& neighbours(int point) const { return neighbours_[point]; }

 private:
  const LidarScan& scan_;
  const BeamPattern& pattern_;
  PatchOptions options_;
  std::vector<BeamNeighbours> neighbours_;  // of each point
  std::vector<std::uint16_t> row_;          // of each point
  std::vector<Eigen::Vector3f> cells_;      // of each row
};

}  // namespace lidar_upsampling
