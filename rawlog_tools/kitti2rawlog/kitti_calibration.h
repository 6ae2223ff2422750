// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::kitti {

/// The lines `name: number number ...` of a calibration file; lines with other content are left
/// out.
using CalibrationFile = std::map<std::string, std::vector<double>>;

/// @throw std::runtime_error the file cannot be read.
[[nodiscard]] CalibrationFile read_calibration_file(const std::string& path);

/// A rig. The vehicle frame of the raw layout is that of the OXTS unit, that of the odometry layout
/// the LiDAR's: +X forward, +Y left, +Z up.
struct Calibration {
  Pose T_vehicle_lidar = Pose::Identity();
  Pose T_vehicle_rectified_0 = Pose::Identity();  ///< of camera 0 after rectification
  std::map<int, Camera>
      cameras;  ///< by KITTI's number 0 to 3; the rectified model, without distortion
};

/// @brief Reads `calib_imu_to_velo.txt`, `calib_velo_to_cam.txt` and `calib_cam_to_cam.txt`.
/// @throw std::runtime_error with file and entry: missing or malformed.
[[nodiscard]] Calibration read_calibration(const std::string& folder);

/// @brief Reads an odometry sequence's `calib.txt`: `P0` to `P3` and `Tr`, from the LiDAR to
/// camera 0. It knows no picture sizes: they are 0.
/// @throw std::runtime_error as above.
[[nodiscard]] Calibration read_sequence_calibration(const std::string& path);

}  // namespace lidar_upsampling::kitti
