// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace lidar_upsampling {

/// What a scan tells of a place.
enum class Sight {
  open,         ///< a surface there would be, or is, seen; or nothing is known
  hidden,       ///< it lies behind what was measured, or where the sensor does not look
  seen_through  ///< beams passed it: nothing is there
};

/// @brief What a scan saw, by direction from its sensor: how far its beams went.
class SeenSpace {
 public:
  /// @param points all of the scan, the ground's included, in the sensor's frame.
  /// @param vertical_step_deg between neighbouring rings.
  SeenSpace(const std::vector<Eigen::Vector3f>& points, double vertical_step_deg);

  /// @brief Judged by the beams around; where some end before the place and some behind, it is
  /// open.
  [[nodiscard]] Sight at(const Eigen::Vector3f& place) const;
  /// @brief Whether something nearer stands in the place's own direction, of what was measured
  /// there, or the sensor does not look that way.
  [[nodiscard]] bool is_out_of_sight(const Eigen::Vector3f& place) const;

 private:
  struct Reach {
    float nearest, farthest;
  };
  [[nodiscard]] int row_of(const Eigen::Vector3f& place) const;
  [[nodiscard]] int column_of(const Eigen::Vector3f& place) const;

  float per_row_, per_column_;  ///< 1 / rad
  int rows_, columns_;
  std::vector<Reach> cells_;
  std::vector<bool> is_out_of_view_;  ///< columns
};

}  // namespace lidar_upsampling
