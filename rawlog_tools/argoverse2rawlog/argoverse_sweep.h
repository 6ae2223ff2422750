// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

#include "argoverse2rawlog/argoverse_calibration.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::argoverse {

/// @brief A sweep `PC_<ns>.ply`. The file has the points in the vehicle frame; the scan has them in
/// the upper LiDAR's, from where half of them were measured and the others from 9 cm below, so that
/// elevations, rings and what hides what are the sensor's. With rings if they are to be had (see
/// beams.h), without columns.
/// @throw std::runtime_error with the file: unreadable, or without x, y, z, intensity,
/// laser_number.
[[nodiscard]] LidarScan read_sweep(const std::string& path, Stamp stamp,
                                   const Calibration& calibration);

}  // namespace lidar_upsampling::argoverse
