// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A rotation vector (rad), then a translation (m).
using Twist = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// The exponential map of SE(3) and its inverse (Barfoot, State Estimation for Robotics, 7.1.3).
[[nodiscard]] Pose exp_se3(const Twist& twist);
[[nodiscard]] Twist log_se3(const Pose& pose);

/// A proper rotation again, after many products.
[[nodiscard]] Pose renormalized(const Pose& pose);

/// Rotation angle in radians.
[[nodiscard]] double rotation_angle(const Pose& pose);

}  // namespace lidar_upsampling
