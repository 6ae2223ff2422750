// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::argoverse {

/// A log's rig. The vehicle frame ("egovehicle") is in the middle of the rear axle.
struct Calibration {
  Pose T_vehicle_up_lidar = Pose::Identity();
  Pose T_vehicle_down_lidar = Pose::Identity();  ///< hangs upside down below the other
  /// By name, as ring_front_center, which is the label too. The files know no picture sizes: they
  /// are 0. The pictures have been freed from distortion, so the coefficients in the file, which
  /// are those of the lens, do not apply.
  std::map<std::string, Camera> cameras;
};

/// @brief Reads `vehicle_calibration_info.json`.
/// @throw std::runtime_error with file and entry: missing or malformed.
[[nodiscard]] Calibration read_calibration(const std::string& path);

}  // namespace lidar_upsampling::argoverse
