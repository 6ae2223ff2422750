// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/camera_view.h"

namespace lidar_upsampling {

/// @brief Follows all points to the next picture, those of an object from each of several motions
/// over ground that it may have made; the one where the picture looks most like it counts.
/// @param T_camera_t_lidar_k ego-motion until the picture included.
/// @param ways motions of each object, the likeliest first.
void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 const std::vector<std::vector<Pose>>& ways, const KltOptions& options);

}  // namespace lidar_upsampling
