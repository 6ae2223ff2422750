// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Writes a .npz of one array of rows x, y, z, intensity as numpy.savez does, or packed as
/// numpy.savez_compressed.
void write_npz(const std::filesystem::path& file, const LidarScan& scan, bool packed);

}  // namespace lidar_upsampling
