// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/metrics/summary.h"
#include "lidar_upsampling/registration/object_registration.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// An object of the key scan, and where it really went.
struct ReferenceMotion {
  Eigen::Vector3d centroid_k = Eigen::Vector3d::Zero();  ///< of its points, in the lidar frame at k
  Pose T_lidar_t_lidar_k = Pose::Identity();             ///< ego- and object motion together
  double sigma_m = 0.02;                                 ///< of the centroid's position
};

/// Whether an object moves over ground: at 0.5 m/s at least, and by three times its uncertainty.
/// @param dt seconds from the key scan to the reference, positive. @throw std::invalid_argument
[[nodiscard]] bool is_moving(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k_ego,
                             double dt);

/// Metres between where the reference and an estimate put the object's centroid.
[[nodiscard]] double position_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k);

/// @brief Error of the centroid's depth along the camera's axis, as a share of the true depth (the
/// paper's trajectory table gives it in percent).
/// @return none: the object is not in front of the camera.
[[nodiscard]] std::optional<double> depth_error(const ReferenceMotion& object,
                                                const Pose& T_lidar_t_lidar_k,
                                                const Pose& T_camera_lidar_t);

/// Radians about the lidar's +Z between the reference's and an estimate's rotation, in [0, pi].
[[nodiscard]] double yaw_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k);

/// @brief m/s between the centroid's true mean velocity and an estimate's; of the ego-motion, the
/// speed over ground.
/// @param dt seconds from the key scan to the reference, positive. @throw std::invalid_argument
[[nodiscard]] double velocity_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k,
                                    double dt);

/// @brief The motion that a virtual scan gave to an object of the key scan: from its own points
/// where they can be told (`matches` of match_by_beam), else by registration to the virtual scan.
/// @param object indices into the key scan.
/// @param surface of the virtual scan without ground; made by the caller once for all objects.
/// @param guesses T_lidar_t_lidar_k, the ego-motion first.
/// @return none: neither way gives a clear answer.
[[nodiscard]] std::optional<Pose> recover_motion(
    const LidarScan& key, const LidarScan& virtual_scan, const std::vector<int>& object,
    const std::vector<int>& matches, const Surface& surface, const std::vector<Pose>& guesses);

}  // namespace lidar_upsampling
