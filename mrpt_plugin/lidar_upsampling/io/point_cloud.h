// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationPointCloud.h>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A CObservationPointCloud with the points of a scan embedded: CPointsMapXYZI, or
/// CSimplePointsMap without intensities. Ring, column and time have no place there.
[[nodiscard]] mrpt::obs::CObservationPointCloud::Ptr make_point_cloud(const LidarScan& scan);

/// @brief Adds to `scan` the valid points and their intensity; intensities above 1 are taken for
/// 8-bit ones.
void read_point_cloud(const mrpt::obs::CObservationPointCloud& observation, LidarScan& scan);

}  // namespace lidar_upsampling
