// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief The direction of an object's longer side, of which one or two are seen: that of the
/// upright box whose sides most of its points lie near to (Zhang, Xu, Dong, Dolan, IV 2017, with
/// their closeness criterion). The smallest box lies along the diagonal of two sides as readily.
/// @param points not empty; level coordinates count.
/// @return rad, from +X, (-pi/2, pi/2].
[[nodiscard]] double yaw_of_sides(const std::vector<Eigen::Vector3f>& points);

}  // namespace lidar_upsampling
