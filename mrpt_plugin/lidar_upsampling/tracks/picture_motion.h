// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/tracks/hypotheses.h"
#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

struct PictureMotionOptions {
  PictureMotionOptions() {
    pose.min_inliers = 6;
    pose.points_per_observation = 4;
  }

  AbsolutePoseOptions pose;  ///< MLESAC and its refinement
  int min_points = 8;        ///< tracked points; fewer: the picture is not asked
  double max_speed = 70;     ///< m/s over ground; faster: no consensus
};

/// @brief One object's motion by the pose of its points on one picture and nothing else (paper,
/// "Estimate Virtual Camera Pose"): P3P in MLESAC gives T_camera_t_lidar_k, which holds ego- and
/// object motion (eq. 2); without the ego-motion it is the object's own (eq. 3).
/// @param T_camera_lidar_k with the ego-motion.
/// @param centroid of the object, lidar frame at k.
/// @return none without consensus.
[[nodiscard]] std::optional<MotionFit> picture_motion(
    const std::vector<Correspondence>& correspondences, const CameraModel& camera,
    const Pose& T_camera_lidar_k, const Eigen::Vector3d& centroid,
    const PictureMotionOptions& options);

/// @brief The published method's answer: the object moves as its points on the picture do.
/// @param fit none: it goes on as it is, by the ego-motion.
[[nodiscard]] MotionAnswer answer_of_picture(const ObjectTrack& track,
                                             const std::optional<MotionFit>& fit,
                                             const MotionQuestion& question,
                                             const PictureMotionOptions& options);

}  // namespace lidar_upsampling
