// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Whether something nearer hides what lies between a cluster's lowest points and the ground
/// under it, as a car does before a van: then the cluster may well stand on the ground, while a
/// sign or a branch, under which the beams reach what is farther off, does not.
/// @param cluster indices into the scan, not empty.
[[nodiscard]] bool foot_is_hidden(const LidarScan& scan, const Ground& ground,
                                  const std::vector<int>& cluster);

}  // namespace lidar_upsampling
