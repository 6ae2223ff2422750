// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief The direction of an object of which one or two sides are seen: that of the upright box
/// whose sides most of its points lie near to (Zhang, Xu, Dong, Dolan, IV 2017, with their
/// closeness criterion; the smallest box lies along the diagonal of two sides as readily). Along
/// the longer side, but for what faces the sensor and is no wider than a car: that is its end.
/// @param points as the sensor at the origin sees them, not empty; level coordinates count.
/// @return rad, from +X, (-pi/2, pi/2].
[[nodiscard]] double yaw_of_sides(const std::vector<Eigen::Vector3f>& points);

}  // namespace lidar_upsampling
