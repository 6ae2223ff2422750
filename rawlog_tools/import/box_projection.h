// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::importing {

/// @brief The rectangle about what a picture shows of a 3D box: what lies outside the picture or
/// behind the camera does not count.
/// @param model without distortion, as all imported pictures are.
/// @param T_camera_object of the box's centre; @param size metres along its axes.
/// @return none where the picture shows nothing of the box, or less than a pixel.
/// @throw std::invalid_argument the model has a distortion.
[[nodiscard]] std::optional<Box2d> project_box(const CameraModel& model,
                                               const Pose& T_camera_object,
                                               const Eigen::Vector3d& size);

}  // namespace lidar_upsampling::importing
