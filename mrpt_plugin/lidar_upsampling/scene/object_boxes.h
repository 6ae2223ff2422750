// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A tracked object as it is shown: the upright box around its points.
struct ObjectBox {
  int track_id = -1;
  std::string class_name;
  bool moving = false;
  Pose T_lidar_box = Pose::Identity();                 ///< centre, +X along `size.x()`
  Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< lidar frame, over ground, m/s
};

/// @brief The boxes of a virtual scan's objects at the image's instant: along the velocity of what
/// moves, else along its longer side. Objects without points left in the scan have none.
[[nodiscard]] std::vector<ObjectBox> object_boxes(const VirtualScan& scan);

/// Whether a point lies in the box or at most `margin` (m) outside.
[[nodiscard]] bool contains(const ObjectBox& box, const Eigen::Vector3d& point_lidar,
                            double margin = 0.05);

}  // namespace lidar_upsampling
