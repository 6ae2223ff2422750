// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The occupied cubes of a grid, in order of first occupation.
struct VoxelGroups {
  std::vector<Eigen::Vector3f> means;  ///< of the points in each cube
  std::vector<int> of_point;           ///< the cube of each point
};

/// @param side_m of a cube; 2^20 of them fit on each side of the origin.
/// @throw std::invalid_argument a side that is not positive.
[[nodiscard]] VoxelGroups group_by_voxel(const std::vector<Eigen::Vector3f>& points, double side_m);

}  // namespace lidar_upsampling
