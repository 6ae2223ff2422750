// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::kitti {

/// One row of the tracking benchmark's label_02: `frame track type truncated occluded alpha left
/// top right bottom height width length x y z rotation_y`.
struct LabelRow {
  int frame = 0;
  int track = 0;
  std::string type;
  Box2d box;  ///< on the picture of camera 2
  /// Of the box's centre, +X along its length, +Z up, in rectified camera 0.
  Pose T_rectified_0_object = Pose::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: length, width, height

  /// Whether it is no object, but an area where nobody labelled any.
  [[nodiscard]] bool is_ignored_area() const { return type == "DontCare"; }
};

/// @throw std::runtime_error it cannot be read, holds no labels, or with the line: it is no such
/// row, its box has no extent, or the track has another row in the frame.
[[nodiscard]] std::vector<LabelRow> read_labels(const std::string& path);

}  // namespace lidar_upsampling::kitti
