// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/camera_view.h"

namespace lidar_upsampling {

/// Where to look for an object's points on the next picture.
struct Ways {
  std::vector<Pose> T_mov;  ///< motions over ground, the likeliest first
  double reach_m = 0;       ///< how far around the first it may also be, level
};

/// @brief Follows all points to the next picture, those of an object from each of several ways it
/// may have gone; the one on which most points are found again counts. Where few are, the likeliest
/// place is sought on smaller pictures first.
/// @param T_camera_t_lidar_k ego-motion until the picture included.
/// @param ways of each candidate; what the search has found is added.
void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 std::vector<Ways>& ways, const KltOptions& options);

}  // namespace lidar_upsampling
