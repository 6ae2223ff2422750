// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The angle between neighbouring rings in degrees, from the ring indices, else from the gaps
/// between the points' elevations; 0.4 where neither shows rings.
[[nodiscard]] double estimate_vertical_step_deg(const LidarScan& scan);

/// The angle between neighbouring columns in degrees, the median over the scan; none where points
/// have no rings and columns, or no two of them are neighbours. A spinning LiDAR's columns go all
/// around, a depth camera's only as far as its view.
[[nodiscard]] std::optional<double> estimate_horizontal_step_deg(const LidarScan& scan);

}  // namespace lidar_upsampling
