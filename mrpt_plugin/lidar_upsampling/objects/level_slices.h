// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/objects/scene_segments.h"

/// What a single ring shows of a roof or a bonnet is no object by itself: it lies where that ring
/// meets a level surface, so that it goes with the sensor rather than with what it belongs to. So
/// it is only where rings are so close that they show more of whatever is upright.
namespace lidar_upsampling {

/// @brief Joins level slices to the clusters below and before them.
void join_level_slices(const LidarScan& scan, SceneSegments& segments);

}  // namespace lidar_upsampling
