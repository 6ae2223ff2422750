// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

[[nodiscard]] Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// @brief J(w) in exp(w + dw) = exp(J(w) dw) exp(w) to first order, w a rotation vector (Barfoot,
/// State Estimation for Robotics, sec. 7.1).
[[nodiscard]] Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w);

[[nodiscard]] Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& w);
[[nodiscard]] Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);

/// @brief [exp(w) | t] * pose, of increment = (w, t).
[[nodiscard]] Pose incremented(const Vector6d& increment, const Pose& pose);

}  // namespace lidar_upsampling
