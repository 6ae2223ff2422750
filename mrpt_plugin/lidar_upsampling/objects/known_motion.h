// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/refine_pose.h"

namespace lidar_upsampling {

/// @brief How an object travels over ground at constant acceleration, level: a Gaussian over its
/// velocity at an instant (m/s) and its acceleration (m/s^2).
struct Travel {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

/// What is known of an object's motion before it is looked at, in a frame at rest.
struct KnownMotion {
  Stamp stamp;  ///< of the instant it was measured at
  Eigen::Vector3d velocity_at_rest = Eigen::Vector3d::Zero();  ///< m/s
  double yaw_rate = 0;                                         ///< rad/s
  bool from_scans = false;                                     ///< by registration; else by images
  bool found_moving = false;  ///< a picture has told it from a parked one
  Eigen::Matrix2d velocity_covariance = Eigen::Matrix2d::Zero();  ///< (m/s)^2, level
  std::optional<Travel> travel;  ///< where followed to the scan at `stamp`, which need not be asked
                                 ///< again; in the axes of the frame at rest
};

/// @brief What an image has told, of the middle of its interval.
/// @param dt seconds from the key scan, of `stamp_k`, to the image.
[[nodiscard]] KnownMotion known_from(const ObjectMotion& motion, Stamp stamp_k, double dt,
                                     const Eigen::Matrix3d& R_rest_lidar_k);

/// @brief Of the object moving at all when it was measured: a chi-square, of two degrees of freedom
/// if it did not. Negative, by the odds, where two scans have clearly seen it stand.
[[nodiscard]] double evidence_of_motion(const KnownMotion& known);

/// @brief Two measurements of one velocity, each weighted by its covariance; `newer` alone where
/// they contradict each other.
/// @param acceleration_sigma m/s^2, by which the velocity may have changed from one to the other.
[[nodiscard]] KnownMotion fused(const KnownMotion& older, const KnownMotion& newer,
                                double acceleration_sigma);

/// @brief Motion over ground per second about the object's own centroid, in the lidar frame at k.
/// @param centroid of the object, lidar frame at k.
[[nodiscard]] Twist rate_over_ground(const KnownMotion& known,
                                     const Eigen::Matrix3d& R_lidar_k_rest,
                                     const Eigen::Vector3d& centroid);

/// Which clues weigh in beside the picture, and how much is expected of a motion.
struct MotionPriorOptions {
  bool from_scans = true;           ///< motion between real scans, by registration
  bool from_images = true;          ///< motion seen on the images of earlier key scans
  bool ground = true;               ///< vehicles stay on the ground and level
  double unknown_speed_sigma = 12;  ///< m/s, of an object seen for the first time
  double acceleration_sigma = 3;    ///< m/s^2
  double yaw_rate_sigma = 0.3;      ///< rad/s, of a known object; four times as much of a new one
  double height_sigma_m = 0.02;     ///< vehicles stay on the ground...
  double tilt_sigma_deg = 0.3;     ///< ...and level, plus this times the time since the key scan...
  double height_rate_sigma = 0.2;  ///< ...m/s
  double tilt_rate_sigma_deg = 3;  ///< ...deg/s

  /// Without any clue there is no prior: the picture alone decides, as in the paper.
  [[nodiscard]] bool any() const { return from_scans || from_images || ground; }
};

/// @brief What to expect of an object's motion over ground from the key scan on, as a Gaussian.
struct MotionPrior {
  Pose T_mov = Pose::Identity();  ///< mean, in the lidar frame at k
  Eigen::Matrix2d position_covariance =
      Eigen::Matrix2d::Zero();  ///< m^2, of the centroid in the ground plane
  double height_sigma_m = 0;
  double yaw_sigma = 0;   ///< rad
  double tilt_sigma = 0;  ///< rad
};

/// @param known none for an object seen for the first time.
/// @param centroid of the object, lidar frame at k.
/// @param dt seconds from the key scan on.
[[nodiscard]] MotionPrior expect_motion(const std::optional<KnownMotion>& known, Stamp key_stamp,
                                        const Eigen::Matrix3d& R_lidar_k_rest,
                                        const Eigen::Vector3d& centroid, double dt,
                                        const MotionPriorOptions& options);

/// @brief The prior as one on T_camera_t_lidar_k, for the pose's refinement.
[[nodiscard]] PosePrior pose_prior(const MotionPrior& prior, const Pose& T_camera_t_lidar_k_ego,
                                   const Eigen::Vector3d& centroid);

/// One object's points in two real scans.
struct ObjectScans {
  std::vector<Eigen::Vector3f> before;             ///< lidar frame at the scan before
  std::vector<Eigen::Vector3f> now;                ///< lidar frame at k
  Pose T_lidar_k_lidar_before = Pose::Identity();  ///< ego-motion
  Pose T_mov_guess = Pose::Identity();  ///< over ground, in the lidar frame at the scan before
  double dt = 0;                        ///< s
};

/// @brief The velocity over ground between two real scans, by registration of the object's points.
/// @return velocity (m/s) and yaw rate in the lidar frame at k, with sigma; none if it is not
/// clear.
[[nodiscard]] std::optional<KnownMotion> measure_between_scans(
    const ObjectScans& scans, Stamp stamp_k, const Eigen::Matrix3d& R_rest_lidar_k);

/// A scan's sight of an object.
struct ObjectSight {
  const std::vector<Eigen::Vector3f>& points;  ///< the object's, lidar frame
  const SeenSpace& seen;
  bool is_whole;  ///< whether it is taken to end where nothing tells of more
};

/// @brief Whether another scan saw a surface wherever the object has one now, so that it cannot
/// have come there in between. A place tells if no other part of the object would have been there:
/// a step further on, nothing is now, or only what is behind the object itself.
/// @param step over ground, level, m, that it is said to have made; the reverse where the other
/// scan is the later one. One too short to tell is no contradiction.
/// @param T_other_lidar ego-motion to the other scan.
[[nodiscard]] bool was_there_then(const ObjectSight& object, const Eigen::Vector2d& step,
                                  const Pose& T_other_lidar, const SeenSpace& other);

}  // namespace lidar_upsampling
