// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The smallest upright box around some points.
struct ClusterExtent {
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();  ///< mean, lidar frame
  float length = 0, width = 0;                         ///< m, of the footprint, length >= width
  float bottom = 0, top = 0;                           ///< m, above the ground

  [[nodiscard]] float height() const { return top - bottom; }
};

/// @param heights of all points above the ground; empty: their z counts.
/// @param cluster indices into `points`, not empty.
[[nodiscard]] ClusterExtent cluster_extent(const std::vector<Eigen::Vector3f>& points,
                                           const std::vector<float>& heights,
                                           const std::vector<int>& cluster);

}  // namespace lidar_upsampling
