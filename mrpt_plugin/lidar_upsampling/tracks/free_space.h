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

/// @brief Whether another scan saw a surface wherever the object has one now, so that it cannot
/// have come there in between. A place tells if no other part of the object would have been there:
/// a step further on, nothing is now, or only what is behind the object itself.
/// @param step over ground, level, m, that it is said to have made; the reverse where the other
/// scan is the later one. One too short to tell is no contradiction.
/// @param T_other_lidar ego-motion to the other scan.
[[nodiscard]] bool was_there_then(const ObjectSight& object, const Eigen::Vector2d& step,
                                  const Pose& T_other_lidar, const SeenSpace& other);

}  // namespace lidar_upsampling
