// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

/// What is known of a pose beforehand: T_camera_source = [exp(w) | t] * T_mean with
/// sqrt_information * (w, t) of unit covariance; w in rad, t in m, of the camera frame.
struct PosePrior {
  Pose T_mean = Pose::Identity();
  Eigen::Matrix<double, 6, 6> sqrt_information = Eigen::Matrix<double, 6, 6>::Zero();
};

/// @brief Least squares of the reprojection errors with Cauchy's loss, by Ceres: first on what lies
/// within `first_gate_px` of `T_initial`, then on the inliers, chosen anew until they no longer
/// change.
/// @return none where `min_inliers` or `min_inlier_ratio` are missed (with a prior, no number is
/// asked for, and without any the prior is the answer).
/// @throw std::invalid_argument as estimate_absolute_pose(), or a prior that is not finite.
[[nodiscard]] std::optional<AbsolutePose> refine_absolute_pose(
    const std::vector<Correspondence>& correspondences, const CameraModel& model,
    const Pose& T_initial, const AbsolutePoseOptions& options = {},
    const std::optional<PosePrior>& prior = std::nullopt);

}  // namespace lidar_upsampling
