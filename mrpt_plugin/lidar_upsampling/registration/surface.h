// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/registration/point_index.h"

namespace lidar_upsampling {

/// @brief One point (the mean) per occupied cube of side `voxel_m`, in order of first occupation.
[[nodiscard]] std::vector<Eigen::Vector3f> voxel_downsampled(
    const std::vector<Eigen::Vector3f>& points, double voxel_m);

/// A point cloud with the surface's normal at each point.
struct Surface {
  PointIndex index;
  std::vector<Eigen::Vector3f> normals;  ///< unit length; zero where the neighbours form no plane
};

struct NormalOptions {
  int num_neighbors = 10;
  double max_radius_m = 2.0;   ///< neighbours further away do not count
  double max_flatness = 0.15;  ///< smallest over middle eigenvalue of the neighbours' scatter
  double min_width = 0.01;     ///< middle over largest eigenvalue: less is a line
};

/// Normals by principal components of the neighbours, in parallel.
[[nodiscard]] Surface make_surface(std::vector<Eigen::Vector3f> points,
                                   const NormalOptions& options = {});

}  // namespace lidar_upsampling
