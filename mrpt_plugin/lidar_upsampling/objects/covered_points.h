// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

/// @brief Which object lies nearest in each part of a picture.
class CoverMap {
 public:
  /// @param cell_width_px, cell_height_px at least the distance of neighbouring points of a scan.
  CoverMap(int width, int height, double cell_width_px, double cell_height_px);

  void add(const Eigen::Vector2d& pixel, double depth_m, int owner);

  /// Whether a point nearer by `min_nearer_m` lies in this cell or next to it.
  /// @param companions by owner: those whose points cover nothing.
  [[nodiscard]] bool covers(const Eigen::Vector2d& pixel, double depth_m,
                            const std::vector<std::uint8_t>& companions, double min_nearer_m) const;

 private:
  struct Cell {
    float depth_m;
    int owner;
  };
  double cell_width_px_, cell_height_px_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

/// @brief Drops pairs whose surroundings a nearer moving object has taken: a patch there is dragged
/// along by the object's edge, and many such agree on a motion that is not theirs.
/// @param map of the moving objects, at the image.
/// @param T_camera_t_source where the pairs' own object is expected.
/// @param companions by owner: the object itself, and those that move along with it.
[[nodiscard]] std::vector<Correspondence> without_covered(
    const std::vector<Correspondence>& correspondences, const CoverMap& map,
    const CameraModel& camera, const Pose& T_camera_t_source,
    const std::vector<std::uint8_t>& companions);

}  // namespace lidar_upsampling
