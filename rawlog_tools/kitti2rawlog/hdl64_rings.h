// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::kitti {

constexpr int kHdl64Rings = 64;
constexpr int kHdl64Columns =
    2250;  ///< of 0.16 degrees, counter-clockwise, column 0 straight ahead

/// @brief Gives the points of a KITTI scan their ring and column. The files carry neither, but are
/// ordered ring by ring from the top, each counter-clockwise from straight ahead, so that a new
/// ring starts where the azimuth falls back. Columns follow the azimuth, up to three steps off, as
/// they are different for all points of a ring.
/// @return false, with the scan as it was, if the points are not in that order.
bool derive_rings(LidarScan& scan);

}  // namespace lidar_upsampling::kitti
