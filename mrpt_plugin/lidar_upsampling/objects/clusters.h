// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// As large as road users may be, m: 18.75 m of length (EU Directive 96/53/EC), 2.55 m of width
/// without mirrors, and a little more.
constexpr double kLongestVehicle_m = 19, kWidestVehicle_m = 3.2;

/// How far apart two points of one object may lie. The gap between rings is bridged by height
/// alone, so that a coarse LiDAR does not join cars side by side.
struct ClusterOptions {
  double min_distance = 0.45;         ///< m, at the sensor...
  double distance_per_range = 0.015;  ///< ...growing by this with every metre from it
  double max_distance = 1;            ///< m
  double beam_gaps = 2.5;             ///< or so many steps of the beams, whatever is more
  double vertical_step_deg = 0.4;     ///< between rings
  double horizontal_step_deg = 0.2;   ///< between columns
  double voxel_size = 0.25;           ///< m, points this close are handled as one
  int min_points = 8;

  // What is too large for one object is split by distances `split_shrink` times as long.
  double max_length = kLongestVehicle_m;  ///< m, of the footprint
  double max_width = kWidestVehicle_m;    ///< m
  double max_low_length = 6;  ///< m, where it is no higher than `low_height`: cars in a queue
  double low_height = 2.2;    ///< m
  double split_shrink = 0.6;
  int max_splits = 1;
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
