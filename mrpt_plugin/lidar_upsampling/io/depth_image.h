// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Whether the observation is a depth camera's: a range picture, and the intrinsics that belong to
/// it. Its pixels may be left external and unloaded.
[[nodiscard]] bool is_depth_image(const mrpt::obs::CObservation3DRangeScan& observation);

/// @brief The scan as the depth camera of `like` shows it: a range picture of the same size,
/// intrinsics, kind and unit of ranges. Neighbours on the key scan's picture (ring and column) span
/// a surface, unless there is a depth edge between them; the nearest surface is what a pixel sees,
/// at its own centre. What comes out from behind another surface has no return. Points without
/// neighbours fill the pixel they lie in. With an intensity picture of the same place in `like`,
/// and intensities in the scan, a gray one comes along.
/// @param with_points also as `points3D`, one for each pixel with a return.
/// @throw std::invalid_argument `like` is no depth image.
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr make_depth_image(
    const LidarScan& scan, const mrpt::obs::CObservation3DRangeScan& like, bool with_points);

}  // namespace lidar_upsampling
