// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A rotation vector (rad), then a translation (m).
using Twist = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// The exponential map of SO(3), of a rotation vector (rad), and its inverse.
[[nodiscard]] Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& w);
[[nodiscard]] Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);

/// @brief J(w) in exp(w + dw) = exp(J(w) dw) exp(w) to first order, w a rotation vector (Barfoot,
/// State Estimation for Robotics, sec. 7.1).
[[nodiscard]] Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w);

/// The exponential map of SE(3) and its inverse (Barfoot, State Estimation for Robotics, 7.1.3).
[[nodiscard]] Pose exp_se3(const Twist& twist);
[[nodiscard]] Twist log_se3(const Pose& pose);

/// @brief [exp(w) | t] * pose, of increment = (w, t): unlike exp_se3, t is not turned on the way.
[[nodiscard]] Pose incremented(const Twist& increment, const Pose& pose);

/// @brief Takes an increment (w, t) to (R w, R (t + w x p)): the turn and the step of point p, in
/// axes turned by R, to first order.
[[nodiscard]] Matrix6d increment_at(const Eigen::Vector3d& p, const Eigen::Matrix3d& R);

/// A vehicle's motion as a sensor on it makes it.
[[nodiscard]] inline Pose between_sensors(const Pose& T_to_from_vehicle,
                                          const Pose& T_vehicle_sensor) {
  return T_vehicle_sensor.inverse() * T_to_from_vehicle * T_vehicle_sensor;
}

/// A proper rotation again, after many products.
[[nodiscard]] Pose renormalized(const Pose& pose);

/// @brief Whether it can be a pose on Earth: finite, and within 1e8 m of the origin, where
/// geocentric and UTM coordinates stay below 1e7. What damaged logs hold may be a finite double
/// that is no finite float.
[[nodiscard]] bool is_possible(const Pose& pose);

/// Rotation angle in radians.
[[nodiscard]] double rotation_angle(const Pose& pose);

}  // namespace lidar_upsampling
