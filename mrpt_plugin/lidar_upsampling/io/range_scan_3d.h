// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A CObservation3DRangeScan with the points of a scan embedded in `points3D`, ring and
/// column in `points3D_idxs_*`, and the intensity (8 bit) in a ring x column picture, highest ring
/// on top. A scan without rings or columns gets another picture layout, so that its intensities
/// travel all the same. Per-point times have no place there. Points that share a cell share the
/// last one's intensity.
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr make_range_scan_3d(const LidarScan& scan);

/// @brief Adds to `scan` the valid points, and their ring (picture row, from below), column and
/// intensity. Of a depth camera's range picture without points, the unprojected ones (+X forward).
void read_range_scan_3d(const mrpt::obs::CObservation3DRangeScan& observation, LidarScan& scan);

}  // namespace lidar_upsampling
