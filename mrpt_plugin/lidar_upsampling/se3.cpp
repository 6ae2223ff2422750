// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/se3.h"

#include <cmath>

namespace lidar_upsampling {

namespace {

/// V of exp(twist) = (R, V * translation).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d hat = skew(omega);
  if (angle < 1e-6) {
    return Eigen::Matrix3d::Identity() + 0.5 * hat;
  }
  const double sq_angle = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / sq_angle * hat +
         (angle - std::sin(angle)) / (sq_angle * angle) * hat * hat;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d hat;
  hat << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return hat;
}

Pose exp_se3(const Twist& twist) {
  const Eigen::Vector3d omega = twist.head<3>();
  const double angle = omega.norm();
  Pose pose = Pose::Identity();
  if (angle > 1e-12) {
    pose.linear() = Eigen::AngleAxisd(angle, omega / angle).toRotationMatrix();
  }
  pose.translation() = left_jacobian(omega) * twist.tail<3>();
  return pose;
}

Twist log_se3(const Pose& pose) {
  const Eigen::AngleAxisd rotation(pose.linear());
  const Eigen::Vector3d omega = rotation.angle() * rotation.axis();
  Twist twist;
  twist << omega, left_jacobian(omega).inverse() * pose.translation();
  return twist;
}

Pose renormalized(const Pose& pose) {
  Pose result = pose;
  result.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return result;
}

double rotation_angle(const Pose& pose) { return Eigen::AngleAxisd(pose.linear()).angle(); }

}  // namespace lidar_upsampling
