// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/tracks/surface_search.h"

namespace lidar_upsampling {

/// The motions over ground that an object may have made.
struct Ways {
  std::vector<Pose> motions;  ///< the likeliest first; none: it is not followed
  PlanarStep step;            ///< of the likeliest, lidar frame at k: where else it may be
};

/// @brief Follows all points to the next picture, those of an object from each motion that it may
/// have made; the one where the picture looks most like it counts. What is at none of these places
/// is looked for wherever it may be.
/// @param T_camera_t_lidar_k ego-motion until the picture included.
/// @param ways of each object.
void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 const std::vector<Ways>& ways, const KltOptions& options);

}  // namespace lidar_upsampling
