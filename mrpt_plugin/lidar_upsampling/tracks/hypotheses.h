// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/motion_estimate.h"
#include "lidar_upsampling/tracks/object_tracks.h"

/// Parked or moving: two nested models of one object at an image, judged by their evidence.
namespace lidar_upsampling {

/// What is asked, and what is known for it.
struct MotionQuestion {
  Stamp instant;
  Pose T_lidar_t_lidar_k = Pose::Identity();   ///< ego-motion
  Matrix6d ego_covariance = Matrix6d::Zero();  ///< of a left increment, lidar frame at t
  Eigen::Vector2d ego_velocity = Eigen::Vector2d::Zero();  ///< m/s over ground, frame at rest
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();      ///< lidar frame at k
  Eigen::Matrix3d R_rest_lidar_k = Eigen::Matrix3d::Identity();
  double focal_px = 700;
  int num_followed = 0;  ///< points of the object, found again or not
};

struct MotionAnswer {
  bool moves = false;
  bool is_seen = false;  ///< whether the picture was heard
  double log_odds = 0;   ///< of moving, with all that is known
  double log_ratio = 0;  ///< of moving, by the picture alone
  MotionFit moving;      ///< as expected, where the picture was not heard
  MotionFit parked;
  TrackState state;   ///< at the instant, if it moves; without what scans to come tell
  int num_found = 0;  ///< points of the object on the picture
};

/// @brief The motion that a state tells, in the axes of the lidar frame at k.
/// @param dt s, since the key scan.
[[nodiscard]] MotionExpected expected_motion(const TrackState& at_instant,
                                             const Eigen::Matrix3d& R_rest_lidar_k, double dt,
                                             const TrackOptions& options);

/// @brief Both hypotheses, and which of them is to be told. The fewer of the followed points agree
/// with either, the likelier the picture was asked at a wrong place, and the less it says.
/// @param starts motions from which the picture may be explained; the expected one is among them.
[[nodiscard]] MotionAnswer estimate_motion(const ObjectTrack& track, const ImageFactor& image,
                                           const MotionQuestion& question,
                                           const std::vector<Twist>& starts,
                                           const TrackOptions& options);

/// @brief What the picture tells is known from here on, unless an earlier one since the object's
/// last sight told its velocity more precisely: pictures that follow the same points err alike, and
/// many are no better than the best. What scans to come tell is not: they will be asked in their
/// turn. What is parked by odds as clear as they get, to which the picture agrees, is settled.
void note_answer(ObjectTrack& track, const MotionAnswer& answer, const MotionNoise& noise);

}  // namespace lidar_upsampling
