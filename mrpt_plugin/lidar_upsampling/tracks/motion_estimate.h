// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/observation.h"

/// One object's motion over ground from the key scan to an instant, from all that is known of it.
/// Such a motion is (w, d): the object turns by the rotation vector w (rad) about its centroid,
/// which moves by d (m), in the axes of the lidar frame at k. Errors of the ego-motion are taken
/// for a part of it, as they cannot be told apart on the picture.
namespace lidar_upsampling {

/// How one picture sees the object.
struct ImageView {
  Pose T_camera_lidar_k = Pose::Identity();  ///< ego-motion until the picture included
  double share = 1;  ///< of `d` that lies between the anchor picture and this one
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m, moved until the anchor, as was assumed
};

/// Followed points of the object on all pictures of an instant.
struct ImageFactor {
  std::vector<ImageView> views;
  std::vector<Observation> observations;
  std::vector<int> view_of;  ///< of each observation

  void add(const ImageView& view, const std::vector<Observation>& seen);
};

/// What is expected of the motion: a Gaussian.
struct MotionExpected {
  Twist mean = Twist::Zero();
  Matrix6d covariance = Matrix6d::Identity();
};

/// How followed points scatter: as Student's t of two dimensions (Lange, Little, Taylor, JASA
/// 1989).
struct PointNoise {
  double sigma_px = 0.5;              ///< expected; measured on the points themselves
  double degrees_of_freedom = 2;      ///< few: many go astray
  double points_per_observation = 4;  ///< neighbouring points err alike: so many count as one
};

/// What a hypothesis makes of the factors.
struct MotionFit {
  Twist mean = Twist::Zero();
  Matrix6d covariance = Matrix6d::Zero();
  double cost = 0;          ///< twice a negative log-likelihood, prior included
  double log_evidence = 0;  ///< by Laplace's approximation, but for a constant of the observations
  int num_inliers = 0;      ///< within three sigmas
  double rmse_px = 0;       ///< of the inliers
  double sigma_px = 0;      ///< scatter of the points, per axis, that was taken
};

/// @brief The mode of prior and picture, from the likeliest of several starts, by Gauss-Newton with
/// reweighting.
/// @param sigma_px of the points, per axis.
[[nodiscard]] MotionFit fit_motion(const ImageFactor& image, const Eigen::Vector3d& centroid,
                                   const MotionExpected& prior, const std::vector<Twist>& starts,
                                   double sigma_px, const PointNoise& noise);

/// @brief The scatter of the points about a motion, per axis, with the expected one as a few more
/// of them, px.
[[nodiscard]] double measured_sigma_px(const ImageFactor& image, const Eigen::Vector3d& centroid,
                                       const Twist& motion, const PointNoise& noise);

/// @brief The same with the scatter that the points show about this very motion: of two motions
/// that one is likelier about which they scatter less. The evidence has the scatter in it, whose
/// prior is that of a few points which scatter as expected.
[[nodiscard]] MotionFit fit_with_scatter(const ImageFactor& image, const Eigen::Vector3d& centroid,
                                         const MotionExpected& prior,
                                         const std::vector<Twist>& starts, const PointNoise& noise);

/// @brief T_mov, lidar frame at k.
[[nodiscard]] Pose motion_pose(const Twist& motion, const Eigen::Vector3d& centroid);

}  // namespace lidar_upsampling
