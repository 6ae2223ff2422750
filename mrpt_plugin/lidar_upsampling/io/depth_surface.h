// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core/mat.hpp>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What a camera in the place of the sensor sees of a scan.
struct DepthSurface {
  cv::Mat depth;      ///< CV_32F, metres along the optical axis; 0: nothing
  cv::Mat intensity;  ///< CV_32F, [0, 1]; empty if the scan has none
};

/// @brief Draws a scan whose rings and columns are the rows (from below) and columns of a picture:
/// triangles between neighbours, depth exact at each pixel's centre (perspective interpolation),
/// the nearest one in front. None lies across a depth edge. Points of no triangle, and those in a
/// crack along a depth edge, are drawn as one pixel.
/// @param model of a camera that looks along +X of the lidar frame, +Z up.
[[nodiscard]] DepthSurface draw_surface(const LidarScan& scan, const CameraModel& model);

}  // namespace lidar_upsampling
