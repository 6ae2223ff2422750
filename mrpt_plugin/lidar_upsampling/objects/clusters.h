// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// How far apart two points of one object may lie. The gap between rings is bridged by height
/// alone, so that a coarse LiDAR does not join cars side by side.
struct ClusterOptions {
  double min_distance = 0.4;         ///< m, at the sensor...
  double distance_per_range = 0.01;  ///< ...growing by this with every metre from it
  double max_distance = 1;           ///< m
  double beam_gaps = 2.5;            ///< or so many steps of the beams, whatever is more
  double vertical_step_deg = 0.4;    ///< between rings
  double horizontal_step_deg = 0.2;  ///< between columns
  double voxel_size = 0.15;  ///< m, points this close are handled as one; 0: each on its own
  int min_points = 8;

  double max_length = 13;      ///< m, clusters of a longer footprint...
  double max_width = 3.2;      ///< m, ...or a wider one are split...
  double split_shrink = 0.65;  ///< ...by distances so much shorter...
  int max_splits = 2;          ///< ...up to so many times
};

/// @brief Euclidean clusters (Rusu 2010): the connected components of points that lie within the
/// range's distance of each other; those too large for an object are split.
/// @param points metres, lidar frame (the origin is the sensor).
/// @param indices of the points to cluster.
/// @return indices into `points`, ascending in each cluster; the largest cluster first.
/// @throw std::invalid_argument options out of range.
[[nodiscard]] std::vector<std::vector<int>> euclidean_clusters(
    const std::vector<Eigen::Vector3f>& points, const std::vector<int>& indices,
    const ClusterOptions& options);

}  // namespace lidar_upsampling
