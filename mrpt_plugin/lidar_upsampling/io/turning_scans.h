// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Counts the rings from the lowest beam where they are counted from the highest, as some
/// drivers do.
void number_rings_upwards(LidarScan& scan);

/// @brief Gives the points of a turning scanner, whose class knows rings but no columns, the
/// azimuth steps that they were measured in, counted the way that it turns, as their order within
/// the rings tells: of time, where they have one, or else of the scan. Nothing changes without
/// rings, or where most of their points do not follow one another in about equal steps.
void find_columns(LidarScan& scan);

}  // namespace lidar_upsampling
