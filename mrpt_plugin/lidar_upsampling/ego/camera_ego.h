// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

/// How far a vehicle's motion may lie from the guess (one sigma, in the lidar frame, over a tenth
/// of a second): wide where it drives and steers, narrow where it cannot go.
struct CameraEgoOptions {
  CameraEgoOptions() { pose.points_per_observation = 4; }

  AbsolutePoseOptions pose;
  /// Of the guess, as EgoStep::covariance, where it is known: in place of the sigmas.
  std::optional<Matrix6d> guess_covariance;
  bool trust_guess = false;  ///< whether other consensus than near the guess is out of the question
  /// Roll, pitch, yaw (rad), forward, sideways, up (m).
  Twist sigmas = (Twist() << 0.005, 0.005, 0.03, 0.3, 0.05, 0.02).finished();
  int min_correspondences = 20;
  double max_step_m = 10;  ///< from the guess; further is no motion of a vehicle
  double max_turn_rad = 0.3;
};

/// @brief Ego-motion from static points of the key scan and their pixels on image t: P3P in MLESAC,
/// then refinement with a vehicle's prior around the guess, from both. Without P3P where the guess
/// is to be trusted: a truck that fills half the picture would be taken for the world.
/// @param correspondences points in the lidar frame at k, pixels as taken; up to half may be wrong.
/// @param guess T_lidar_t_lidar_k, e.g. at constant velocity; the identity if nothing is known.
/// @return T_lidar_t_lidar_k; none: too few, no consensus, or a motion that no vehicle makes.
/// @throw std::invalid_argument as estimate_absolute_pose().
[[nodiscard]] std::optional<EgoStep> estimate_camera_ego(
    const std::vector<Correspondence>& correspondences, const CameraModel& model,
    const Pose& T_camera_lidar, const CameraEgoOptions& options, const Pose& guess);

}  // namespace lidar_upsampling
