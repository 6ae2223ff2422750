// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/registration/surface.h"

namespace lidar_upsampling {

/// A point's nearest of a surface, and how far the point may go without another one being nearer.
struct NearestPoint {
  int index = -1;                                   ///< into the surface's points; -1: none
  Eigen::Vector3f asked = Eigen::Vector3f::Zero();  ///< the place that was looked from
  float others_m = 0;                               ///< no other point was nearer to it
};

/// @brief Looks up the nearest within `reach_m`, as Surface::nearest finds it. A point that comes
/// to rest, iteration by iteration, keeps its own without a search.
/// @param nearest_point in and out, of the place before.
void look_up(const Surface& surface, const Eigen::Vector3f& place, float reach_m,
             NearestPoint& nearest_point);

}  // namespace lidar_upsampling
