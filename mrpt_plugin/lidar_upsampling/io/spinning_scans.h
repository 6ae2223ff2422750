// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A CObservationVelodyneScan without raw packets: points, 8-bit intensity, ring as laser
/// id, and per-point times as far as the scan has them.
[[nodiscard]] mrpt::obs::CObservationVelodyneScan::Ptr make_velodyne_scan(const LidarScan& scan);

/// @brief Adds to `scan` the points of the observation's point cloud, or, if that is empty, of its
/// raw packets, with intensity, ring and time. The observation is left as it is.
/// @throw std::exception raw packets of an unknown model without calibration.
void read_velodyne_scan(mrpt::obs::CObservationVelodyneScan& observation, LidarScan& scan);

/// @brief Adds to `scan` the points of the range picture, with intensity, ring and column. The
/// class holds no elevations: they come from MRPT's calibration of the model.
/// @throw std::runtime_error a model that MRPT has no calibration of.
void read_rotating_scan(const mrpt::obs::CObservationRotatingScan& observation, LidarScan& scan);

}  // namespace lidar_upsampling
