// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::importing {

/// @brief Parses a file and hands it to `use`.
/// @throw std::runtime_error with the file: unreadable, no JSON, or not what `use` expects of it.
void with_json(const std::string& path, const std::function<void(const nlohmann::json&)>& use);

/// @brief A rigid motion of a quaternion w, x, y, z and three metres, as `rotation` and
/// `translation`; the quaternion may lie in `rotation.coefficients`.
/// @throw nlohmann::json::exception or std::invalid_argument it is no such thing.
[[nodiscard]] Pose pose_from_json(const nlohmann::json& json);

/// The rotation of a quaternion that need not have unit length.
/// @throw std::invalid_argument it has no length.
[[nodiscard]] Eigen::Matrix3d rotation_from(double w, double x, double y, double z);

}  // namespace lidar_upsampling::importing
