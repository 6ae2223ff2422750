// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <map>
#include <optional>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What the user knows better than the log about one camera.
struct CameraOverride {
  std::optional<double> fx, fy, cx, cy;  ///< pixels
  std::optional<int> width, height;      ///< of the pictures that the calibration was made on
  std::optional<DistortionModel> distortion_model;
  std::optional<std::array<double, 8>> distortion;
  std::optional<Pose> T_vehicle_camera;
};

/// By sensor label.
struct RigOverrides {
  std::map<std::string, CameraOverride> cameras;
  std::map<std::string, Pose> T_vehicle_lidar;
};

/// @brief Reads the sections `[camera.<LABEL>]` and `[lidar.<LABEL>]`, all keys optional:
///
///     [camera.CAM2]
///     fx_px = 721.5                     ; also fy_px, cx_px, cy_px, width_px, height_px
///     distortion_model = plumb_bob      ; none, plumb_bob, kannala_brandt
///     distortion = k1 k2 p1 p2 k3 ...   ; 4 to 8 numbers, in MRPT's order
///     pose = x_m y_m z_m yaw_deg pitch_deg roll_deg   ; on the vehicle, camera +Z forward
///     [lidar.LIDAR]
///     pose = x_m y_m z_m yaw_deg pitch_deg roll_deg
///
/// @throw std::invalid_argument an unknown key, or a value that cannot be read, with section and
/// key.
[[nodiscard]] RigOverrides load_rig_overrides(const mrpt::config::CConfigFileBase& config);

/// @brief Replaces what is given. Intrinsics given with a size are scaled to the camera's own size.
void apply(const RigOverrides& overrides, Camera& camera);
void apply(const RigOverrides& overrides, LidarScan& scan);

}  // namespace lidar_upsampling
