// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/registration/seen_space.h"

namespace lidar_upsampling {

/// A scan's sight of an object.
struct ObjectSight {
  const std::vector<Eigen::Vector3f>& points;  ///< the object's, lidar frame
  const SeenSpace& seen;
};

/// @brief Whether the object ends where it seems to, on one side: not because something nearer
/// hides the rest of it.
/// @param ahead unit vector towards that side, level, lidar frame.
[[nodiscard]] bool ends_in_sight(const ObjectSight& object, const Eigen::Vector2d& ahead);

}  // namespace lidar_upsampling
