// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "rawlog-evaluate/truth.h"
#include "voxel_set.h"

namespace lidar_upsampling::maps {

struct MapOptions {
  double voxel_m = 0.2;
  double max_range_m = 40;  ///< of points, from the sensor: farther ones lie too sparse
};

/// A box that a moving object filled at some instant: T_box_world, and half its sides.
struct FilledBox {
  Pose T_box_world = Pose::Identity();
  Eigen::Vector3d half_size = Eigen::Vector3d::Zero();

  [[nodiscard]] bool holds(const Eigen::Vector3d& point_in_world) const;
};

/// What the maps are judged by.
struct Reference {
  Trajectory T_world_vehicle;
  VoxelSet at_rest;                   ///< where the reference's scans saw the world at rest
  std::vector<FilledBox> swept;       ///< by the moving objects of the truth, at all its stamps
  std::vector<std::string> warnings;  ///< of its log, as for_each_scan()
};

/// @brief The world at rest as all scans of a log show it, along the log's own way.
/// @param truth none: nothing is known to move, so all of the log counts as at rest.
/// @throw std::runtime_error as trajectory_of() and for_each_scan().
[[nodiscard]] Reference make_reference(const LogFile& log, const std::optional<Truth>& truth,
                                       const MapOptions& options);

/// Of the map that a log's scans make at the reference's poses. Shares are of voxels.
struct MapFigures {
  int num_real = 0, num_virtual = 0;
  std::size_t num_voxels = 0;
  double coverage = 0;         ///< share of the reference's that are occupied in the map
  std::size_t num_ghosts = 0;  ///< where there have been moving objects only
  std::size_t num_others = 0;  ///< farther than a voxel from any of the reference's, and no ghosts
  std::vector<std::string> warnings;  ///< of its log, as for_each_scan()
};

/// @throw std::runtime_error as for_each_scan().
[[nodiscard]] MapFigures compare_map(const LogFile& log, const Reference& reference,
                                     const MapOptions& options);

}  // namespace lidar_upsampling::maps
