// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::dgp {

struct Sensor {
  Pose T_vehicle_sensor = Pose::Identity();
  CameraModel model;  ///< of zero focal length where it is no camera; the files know no sizes
};

/// By the sensors' names, as CAMERA_01.
using Calibration = std::map<std::string, Sensor>;

/// @brief Reads a file of the folder `calibration`.
/// @throw std::runtime_error with file and entry: missing or malformed, or a camera with a skew or
/// a distortion.
[[nodiscard]] Calibration read_calibration(const std::string& path);

/// @brief A rigid motion of `rotation` (qw, qx, qy, qz) and `translation` (x, y, z).
/// @throw nlohmann::json::exception or std::invalid_argument it is no such thing.
[[nodiscard]] Pose pose_from(const nlohmann::json& json);

}  // namespace lidar_upsampling::dgp
