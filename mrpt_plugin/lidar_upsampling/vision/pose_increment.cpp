// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/pose_increment.h"

#include <cmath>

namespace lidar_upsampling {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double sq = w.squaredNorm();
  const Eigen::Matrix3d m = cross_matrix(w);
  if (sq < 1e-8) return Eigen::Matrix3d::Identity() + 0.5 * m + m * m / 6;
  const double angle = std::sqrt(sq);
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / sq * m +
         (angle - std::sin(angle)) / (sq * angle) * m * m;
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity() + cross_matrix(w);
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * angle_axis.axis();
}

Pose incremented(const Vector6d& increment, const Pose& pose) {
  const Eigen::Matrix3d rotation = rotation_exp(increment.head<3>());
  Pose result = Pose::Identity();
  result.linear() = rotation * pose.linear();
  result.translation() = rotation * pose.translation() + increment.tail<3>();
  return result;
}

}  // namespace lidar_upsampling
