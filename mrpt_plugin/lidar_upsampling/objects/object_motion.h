// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

struct ObjectMotionOptions {
  ObjectMotionOptions() {
    pose.min_inliers = 6;
    pose.points_per_observation = 4;
  }

  AbsolutePoseOptions pose;   ///< MLESAC and its refinement
  MotionPriorOptions prior;   ///< off: the paper
  int min_points = 8;         ///< tracked points; fewer: the picture is not asked
  double max_speed = 70;      ///< m/s over ground; faster: no consensus
  bool drop_covered = true;   ///< points that a nearer moving object covers by now say nothing
  bool part_standing = true;  ///< what stands beside a mover is no part of it; off: the paper
  /// Whether an object that cannot be told from a parked one stays parked; off: the paper.
  bool static_test = true;
  bool world_tracks = true;           ///< each object one track in the world; off: the paper
  double static_significance = 16.8;  ///< chi-square of 6 degrees of freedom, 1 % by default
  double static_tolerance_px =
      0.35;  ///< what ego-motion and calibration may be wrong on the picture
};

/// What is known when an object's motion is asked for.
struct MotionQuery {
  CameraModel camera;
  Pose T_camera_lidar = Pose::Identity();
  Pose T_lidar_t_lidar_k = Pose::Identity();  ///< ego-motion
  Eigen::Vector3d centroid_lidar_k = Eigen::Vector3d::Zero();
  double known_evidence = 0;  ///< of motion between the last two scans, as a chi-square
  bool next_tells = false;    ///< the next scan is to decide: a hint of motion is enough
  bool known_moving = false;  ///< found to move before: goes on where nothing else is told
  MotionPrior prior;          ///< object motion to expect
  double dt = 0;              ///< s, from the key scan to the image
};

/// @brief One object's motion from 3D-2D correspondences of its points (paper, section "Estimate
/// Virtual Camera Pose"): P3P in MLESAC gives T_camera_t_lidar_k, which holds ego- and object
/// motion (eq. 2); T_mov = T_lidar_k_camera_t(ego) * T_camera_t_lidar_k (eq. 3). Beyond the paper,
/// each to be switched off: the motion known before weighs in as a Gaussian prior, and the parked
/// hypothesis wins unless picture and prior together speak against it (likelihood ratio).
/// @param correspondences points in the lidar frame at k, pixels on the image at t.
/// @return motions, status and evidence; ids, box and points are the caller's to fill.
[[nodiscard]] ObjectMotion estimate_object_motion(
    const std::vector<Correspondence>& correspondences, const MotionQuery& query,
    const ObjectMotionOptions& options);

/// @brief Completes the motion's derived fields (T_mov, velocity, yaw rate) from
/// `T_lidar_t_lidar_k` and the ego-motion.
void set_motion(ObjectMotion& motion, const Pose& T_lidar_t_lidar_k, const MotionQuery& query);

}  // namespace lidar_upsampling
