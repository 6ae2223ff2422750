// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The rigid motion between two scans, with the evidence.
struct Registration {
  Pose T_target_source = Pose::Identity();
  double inlier_share = 0;                        ///< of the source points that found a plane
  double rmse_m = 0;                              ///< point to plane, of the inliers
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  ///< m, as gone or as guessed, whichever is longer
  double hold = 0;  ///< share of the points that would hold that way, if those that do lay square
                    ///< to it
  Matrix6d covariance = Matrix6d::Zero();  ///< of a Twist applied on the left, in the target frame
};

/// @brief Point-to-plane ICP with a robust kernel that narrows: what moves on its own is left out.
/// Deterministic for any number of threads.
/// @param points_source, points_target in metres, each in its own frame.
/// @param T_target_source_guess right to about a metre and a few degrees.
/// @return none: too few points, no agreement, or a direction that the scene leaves free (to 0.2
/// m).
[[nodiscard]] std::optional<Registration> register_scans(
    const std::vector<Eigen::Vector3f>& points_source,
    const std::vector<Eigen::Vector3f>& points_target, const Pose& T_target_source_guess);

}  // namespace lidar_upsampling
