// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/vision/refine_pose.h"

/// Costs are twice a negative log-likelihood, so that their differences are likelihood-ratio
/// statistics.
namespace lidar_upsampling {

/// @brief Of the reprojection errors, Cauchy distributed with scale `sigma_px`.
[[nodiscard]] double picture_cost(const std::vector<Correspondence>& correspondences,
                                  const CameraModel& camera, const Pose& T_camera_source,
                                  double sigma_px);

/// @brief Of a pose under the prior: its squared Mahalanobis distance.
[[nodiscard]] double prior_cost(const PosePrior& prior, const Pose& T_camera_source);

/// @brief refine_absolute_pose() from several starts; the answer of least cost, picture and prior
/// together. A crowd of points that moves on its own does not win against a prior that knows
/// better. The picture weighs in by the noise that the inliers show.
[[nodiscard]] std::optional<AbsolutePose> refine_likeliest_pose(
    const std::vector<Correspondence>& correspondences, const CameraModel& camera,
    const std::vector<Pose>& starts, const AbsolutePoseOptions& options, const PosePrior& prior);

}  // namespace lidar_upsampling
