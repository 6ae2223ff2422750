// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::exporting {

/// @brief A PLY file (binary, little-endian) with the points in the lidar frame: float x, y, z, and
/// as far as the scan has them float intensity (0 to 1), ushort ring and column, float time (s from
/// the stamp).
/// @throw std::runtime_error the file cannot be written.
void write_ply(const std::string& path, const LidarScan& scan);

/// @brief KITTI's velodyne format: float x, y, z, intensity, point by point; intensity 0 where the
/// scan has none.
void write_bin(const std::string& path, const LidarScan& scan);

}  // namespace lidar_upsampling::exporting
