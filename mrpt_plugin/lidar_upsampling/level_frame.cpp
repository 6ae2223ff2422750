// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/level_frame.h"

#include <Eigen/Geometry>
#include <cmath>

namespace lidar_upsampling {
namespace {

Pose conjugated(const Pose& T, const Eigen::Matrix3d& R) {
  Pose result = T;
  result.linear() = R * T.linear() * R.transpose();
  result.translation() = R * T.translation();
  return result;
}

void put_in_axes(ObjectMotion& object, const Eigen::Matrix3d& R) {
  object.T_lidar_t_lidar_k = conjugated(object.T_lidar_t_lidar_k, R);
  object.T_mov = conjugated(object.T_mov, R);
  object.rate_lidar_k.head<3>() = (R * object.rate_lidar_k.head<3>()).eval();
  object.rate_lidar_k.tail<3>() = (R * object.rate_lidar_k.tail<3>()).eval();
  object.centroid_lidar_k = (R * object.centroid_lidar_k).eval();
  object.velocity_lidar_k = (R * object.velocity_lidar_k).eval();
  object.position_covariance = (R * object.position_covariance * R.transpose()).eval();
}

}  // namespace

Eigen::Matrix3d level_rotation(const Pose& T_vehicle_lidar) {
  constexpr double kLevel = 0.02;  // rad: the vehicle itself pitches as much
  const Eigen::Matrix3d R = T_vehicle_lidar.linear();
  if (R.col(2).head<2>().norm() < kLevel) return Eigen::Matrix3d::Identity();
  const double heading = std::atan2(R(1, 0), R(0, 0));
  return Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) * R;
}

void put_in_axes(LidarScan& scan, const Eigen::Matrix3d& R_new_old) {
  if (R_new_old.isIdentity(0)) return;
  const Eigen::Matrix3f R = R_new_old.cast<float>();
  for (Eigen::Vector3f& point : scan.points) point = (R * point).eval();
  scan.T_vehicle_lidar.linear() = (scan.T_vehicle_lidar.linear() * R_new_old.transpose()).eval();
}

void put_in_axes(VirtualScan& scan, const Eigen::Matrix3d& R_new_old) {
  if (R_new_old.isIdentity(0)) return;
  put_in_axes(scan.scan, R_new_old);
  scan.T_lidar_t_lidar_k = conjugated(scan.T_lidar_t_lidar_k, R_new_old);
  scan.T_rest_lidar_t = conjugated(scan.T_rest_lidar_t, R_new_old);
  for (ObjectMotion& object : scan.objects) put_in_axes(object, R_new_old);
  for (OtherCluster& cluster : scan.other_clusters)
    cluster.centroid_lidar_k = (R_new_old * cluster.centroid_lidar_k).eval();
}

}  // namespace lidar_upsampling
