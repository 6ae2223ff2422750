// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core/mat.hpp>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/objects/anchored_scan.h"

namespace lidar_upsampling {

/// @brief Chooses the points that are followed of each candidate, and static ones (paper, "Defining
/// Object Points and Tracking Them").
/// @param texture of the anchor picture, as choose_spread has it.
/// @param T_camera_lidar_a lidar frame at k to the camera at the anchor, the ego-motion included.
void choose_points(CameraView& view, const AnchoredScan& anchored, const cv::Mat& texture,
                   const LidarScan& scan, const Pose& T_camera_lidar_a, bool with_static_points,
                   const Config& config);

}  // namespace lidar_upsampling
