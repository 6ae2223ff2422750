// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/tracks/motion_estimate.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What one picture shows of one object of the key scan.
struct ObjectOnPicture {
  std::vector<Observation> seen;   ///< its followed points that were found
  int num_followed = 0;            ///< found or not
  ImageView view;                  ///< `share` in seconds since the object's own sight
  std::vector<Twist> starts;       ///< motions that led to the points
  std::optional<MotionFit> alone;  ///< what the picture says by itself, where it was asked
};

/// What one image says.
struct ImageResult {
  Stamp stamp, instant;
  Camera camera;
  EgoStep ego;                           ///< T_lidar_t_lidar_k
  std::vector<ObjectOnPicture> objects;  ///< of each; none where nothing was followed
};

}  // namespace lidar_upsampling
