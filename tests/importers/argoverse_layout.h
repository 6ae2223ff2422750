// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>

#include "small_street.h"

namespace lidar_upsampling {

/// The street seen by Argoverse's two LiDARs, one upside down below the other, at 10 Hz and by its
/// front camera at 30 Hz.
struct ArgoverseLog {
  explicit ArgoverseLog(const std::filesystem::path& folder);

  SmallStreet street;
  Pose T_vehicle_up, T_vehicle_down;
  Pose T_city_world;
  /// The points written for each sweep, in the vehicle frame, and which beam each is of: the laser
  /// number, 32 more for the lower LiDAR's.
  struct Sweep {
    std::vector<Eigen::Vector3d> points;
    std::vector<int> beam;
    std::vector<int> intensity;
  };
  std::vector<Sweep> sweeps;
  std::vector<Stamp> pictures;
};

/// The elevation of a beam as it is mounted, radians.
[[nodiscard]] double mounted_elevation(int beam);

}  // namespace lidar_upsampling
