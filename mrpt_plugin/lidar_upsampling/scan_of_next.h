// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/prepared_scan.h"
#include "lidar_upsampling/scan/compose.h"

namespace lidar_upsampling {

/// @brief What the next scan's points do until the image's instant, back in time. An object that
/// moves takes along what lies where it will be by then, and the rest of a cluster that mostly
/// does. Left out is what is neither an object's nor at rest: it stands where the key scan saw
/// nothing.
/// @param of_key the key scan's, at the same instant.
/// @param seen_k by the key scan.
[[nodiscard]] ScanMotion motion_of_next(const PreparedScan& next, const ScanMotion& of_key,
                                        const LidarScan& key_scan, const SeenSpace& seen_k);

}  // namespace lidar_upsampling
