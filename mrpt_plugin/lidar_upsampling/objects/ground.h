// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "lidar_upsampling/robust/msac_plane.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct GroundOptions {
  double cell_size = 1.5;        ///< m
  double max_range = 100;        ///< m, beyond, the ground is taken as level
  double max_tilt_deg = 15;      ///< of the ground near the sensor from the vehicle's xy plane
  double plane_range = 30;       ///< m, cells that the plane is fitted to
  double plane_tolerance = 0.2;  ///< m
  int min_plane_cells = 25;
  double max_sensor_height = 6;   ///< m above the plane; farther away it is no ground of ours
  double max_step = 0.08;         ///< m, from a cell to the next...
  double max_slope = 0.08;        ///< ...plus this times the distance, relative to the plane
  double max_height_jump = 0.4;   ///< m, across cells without ground
  double ground_thickness = 0.2;  ///< m, points up to here above the local ground belong to it
  double vertical_step_deg = 0;   ///< between neighbouring rings; 0: as the scan shows
};

enum class GroundStatus { found, none };

/// The ground of a scan; with status `none` the vectors are empty and every point may be an
/// object's.
struct Ground {
  GroundStatus status = GroundStatus::none;
  Plane plane;                          ///< lidar frame, normal up: the ground near the sensor
  std::vector<float> height;            ///< m, of each point above the local ground
  std::vector<std::uint8_t> is_ground;  ///< of each point
};

/// @brief Ground points of a scan: an MSAC plane (paper, section "Defining Object Points") through
/// the lowest returns of each cell near the sensor, from which the local ground is followed
/// outwards, cell by cell, as real roads are no planes. Where rings are farther apart than the
/// ground is thick, what something stands straight upon is not ground.
/// @param scan of any number of rings, its height above the ground not needed.
/// @throw std::invalid_argument options out of range.
[[nodiscard]] Ground estimate_ground(const LidarScan& scan, const GroundOptions& options = {});

/// The scan's points that do not lie on its ground, which is sought.
[[nodiscard]] std::vector<Eigen::Vector3f> without_ground(const LidarScan& scan,
                                                          const GroundOptions& options = {});

}  // namespace lidar_upsampling
