// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lidar_upsampling/robust/ransac.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A point and where it is seen.
struct Correspondence {
  Eigen::Vector3d point_in_source;  ///< metres
  Eigen::Vector2d pixel;            ///< on the picture as taken, lens distortion included
  /// Of the pixel, px^2, as the patch's texture lets it slide; beside what all points err by.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

struct AbsolutePoseOptions {
  double sigma_px = 0.5;              ///< of an inlier's pixel, per axis
  double points_per_observation = 1;  ///< neighbouring points err alike: so many count as one
  double outlier_range_px = 40;       ///< side of the square an outlier is equally likely to lie in
  double max_inlier_sigmas = 3.03;    ///< of the reprojection error's length; 99 % of the inliers
  double loss_scale_px = 1.5;         ///< of the Cauchy loss
  double first_gate_px = 6;  ///< what a pose to be refined must see this close to count at first
  int min_inliers = 8;
  double min_inlier_ratio = 0.3;
  int max_refine_iterations = 30;
  RansacOptions ransac{20, 300, 0.999, 1};
};

/// A pose and the evidence for it.
struct AbsolutePose {
  Pose T_camera_source = Pose::Identity();
  std::vector<std::uint8_t> inliers;  ///< 1 for each correspondence that agrees
  int num_inliers = 0;
  double rmse_px = 0;  ///< of the inliers' reprojection errors (lengths)
  /// Of the left increment (w, t) in T_camera_source = [exp(w) | t] * T_estimated: a rotation
  /// vector (rad) and a translation (m) of the camera frame.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  bool converged = false;
};

/// @throw std::invalid_argument
void check(const AbsolutePoseOptions& options);

/// @brief The pose of a camera from points and their pixels, some of them wrong: P3P within MLESAC
/// (Torr & Zisserman, CVIU 2000; the paper's perspective-n-point step), then
/// refine_absolute_pose().
/// @param initial an extra hypothesis, e.g. from the motion before.
/// @return none without consensus: fewer than `min_inliers` or `min_inlier_ratio` of all agree.
/// @throw std::invalid_argument options or camera model out of range, a coordinate that is not
/// finite.
[[nodiscard]] std::optional<AbsolutePose> estimate_absolute_pose(
    const std::vector<Correspondence>& correspondences, const CameraModel& model,
    const AbsolutePoseOptions& options = {}, const std::optional<Pose>& initial = std::nullopt);

/// @brief Distances in pixels between where points project to and where they are seen; infinity for
/// points behind the camera or outside the lens model.
[[nodiscard]] std::vector<double> reprojection_errors(
    const std::vector<Correspondence>& correspondences, const CameraModel& model,
    const Pose& T_camera_source);

}  // namespace lidar_upsampling
