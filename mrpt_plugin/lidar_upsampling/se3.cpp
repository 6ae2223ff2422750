// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/se3.h"

#include <cmath>

namespace lidar_upsampling {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d hat;
  hat << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return hat;
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity() + skew(w);
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * angle_axis.axis();
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d hat = skew(w);
  // Of smaller angles, the cosine's difference from 1 has fewer digits than the series.
  if (angle < 1e-4) return Eigen::Matrix3d::Identity() + 0.5 * hat + hat * hat / 6;
  const double sq_angle = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / sq_angle * hat +
         (angle - std::sin(angle)) / (sq_angle * angle) * hat * hat;
}

Pose exp_se3(const Twist& twist) {
  const Eigen::Vector3d w = twist.head<3>();
  Pose pose = Pose::Identity();
  pose.linear() = rotation_exp(w);
  pose.translation() = left_jacobian(w) * twist.tail<3>();
  return pose;
}

Twist log_se3(const Pose& pose) {
  const Eigen::Vector3d w = rotation_log(pose.linear());
  Twist twist;
  twist << w, left_jacobian(w).inverse() * pose.translation();
  return twist;
}

Pose incremented(const Twist& increment, const Pose& pose) {
  const Eigen::Matrix3d rotation = rotation_exp(increment.head<3>());
  Pose result = Pose::Identity();
  result.linear() = rotation * pose.linear();
  result.translation() = rotation * pose.translation() + increment.tail<3>();
  return result;
}

Matrix6d increment_at(const Eigen::Vector3d& p, const Eigen::Matrix3d& R) {
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R;
  J.bottomLeftCorner<3, 3>() = -R * skew(p);
  J.bottomRightCorner<3, 3>() = R;
  return J;
}

Pose renormalized(const Pose& pose) {
  Pose result = pose;
  result.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return result;
}

bool is_possible(const Pose& pose) {
  constexpr double kFarthest = 1e8;  // m
  return pose.matrix().allFinite() && pose.translation().cwiseAbs().maxCoeff() < kFarthest;
}

double rotation_angle(const Pose& pose) { return Eigen::AngleAxisd(pose.linear()).angle(); }

}  // namespace lidar_upsampling
