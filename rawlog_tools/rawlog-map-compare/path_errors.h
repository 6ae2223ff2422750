// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

#include "lidar_upsampling/ego/trajectory.h"

namespace lidar_upsampling::maps {

/// Of a simplemap's poses at real scans, the first one laid on the true one. Scans that the program
/// could not match are not in the simplemap.
struct PathErrors {
  int num_real = 0, num_virtual = 0;
  int num_beyond = 0;   ///< real scans that the true way does not reach: not in the figures
  double length_m = 0;  ///< of the true way
  double mean_m = 0;    ///< of the distances to the true places, in the plane
  double last_m = 0;
  double last_yaw_deg = 0;
};

/// @brief How far a SLAM program's poses lie from the true ones.
/// @param path a simplemap, as icp-slam and rbpf-slam write it.
/// @throw std::runtime_error no such file, no real scan in it, or the true way does not
/// reach the half of them.
[[nodiscard]] PathErrors errors_of_path(const std::string& path, const Trajectory& T_world_vehicle);

}  // namespace lidar_upsampling::maps
