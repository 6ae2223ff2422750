// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/tracks/track_state.h"

namespace lidar_upsampling {

/// One object in two real scans.
struct ObjectScans {
  const Surface& before;                           ///< lidar frame at the scan before
  const Surface& now;                              ///< lidar frame at k
  Pose T_lidar_k_lidar_before = Pose::Identity();  ///< ego-motion
  Pose T_mov_guess = Pose::Identity();     ///< over ground, in the lidar frame at the scan before
  double turn_sigma_rad = 0;               ///< over ground; 0: any turn is as likely
  double points_per_observation = 4;       ///< neighbouring points err alike: so many count as one
  const SeenSpace* seen_before = nullptr;  ///< free space of either scan: what is hidden from it
  const SeenSpace* seen_now = nullptr;     ///< needs no counterpart there; null: not known
};

/// @brief The step over ground between two real scans, by registration of the object's points. A
/// few points tell little of how well it is known.
/// @param R_rest_lidar_k axes that the step is told in.
/// @return none if it is not clear.
[[nodiscard]] std::optional<PlanarStep> registered_step(const ObjectScans& scans,
                                                        const Eigen::Matrix3d& R_rest_lidar_k);

}  // namespace lidar_upsampling
