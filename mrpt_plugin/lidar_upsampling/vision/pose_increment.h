// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/vision/mlesac_pose.h"

namespace lidar_upsampling {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kNearestDepth = 1e-3;  ///< metres; nearer points count as behind the camera

[[nodiscard]] Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// @brief exp(w) = I + [w]x J(w)... of a rotation vector w: exp(w + dw) = exp(J(w) dw) exp(w) to
/// first order (Barfoot, State Estimation for Robotics, eq. 7.77b).
[[nodiscard]] Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w);

[[nodiscard]] Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& w);
[[nodiscard]] Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);

/// @brief [exp(w) | t] * pose, of increment = (w, t).
[[nodiscard]] Pose incremented(const Vector6d& increment, const Pose& pose);

/// A reprojection error in pixels, and its derivative by an increment of the pose.
struct Reprojection {
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, 6> jacobian;
};

/// @return none behind the camera.
[[nodiscard]] std::optional<Reprojection> reprojection(const Observation& observation,
                                                       const Pose& T_camera_source);

}  // namespace lidar_upsampling
