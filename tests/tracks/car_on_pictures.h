// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/motion_estimate.h"

/// A car's points, and how cameras see them.
namespace lidar_upsampling::testing {

inline const Stamp kStart{mrpt::Clock::duration(10'000'000)};
inline const Eigen::Vector3d kCentroid(12, 0, 0);

/// A camera at the lidar that looks along its +X.
inline Pose ahead() {
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return T_camera_lidar;
}

/// One 12 m to the right of the car that looks to the left, along the lidar's +Y.
inline Pose to_the_left() {
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T_camera_lidar.translation() = -(T_camera_lidar.linear() * Eigen::Vector3d(12, -12, 0));
  return T_camera_lidar;
}

/// Its back and its right side.
inline std::vector<Eigen::Vector3d> car() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 60; ++i) {
    const double along = 0.1 * (i % 10), up = 0.25 * (i / 10 % 6) - 0.6;
    points.push_back(i % 2 == 0 ? Eigen::Vector3d(10, 2 * along - 0.9, up)
                                : Eigen::Vector3d(10 + 4 * along, -0.9, up));
  }
  return points;
}

/// Where a camera of 700 px focal length sees the points after a motion.
inline std::vector<Observation> seen_on(const Pose& T_camera_lidar,
                                        const std::vector<Eigen::Vector3d>& points,
                                        const Twist& motion) {
  const Pose T = T_camera_lidar * motion_pose(motion, kCentroid);
  std::vector<Observation> seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d at = T * points[i];
    seen.push_back(
        {points[i], at.head<2>() / at.z(), 700 * Eigen::Matrix2d::Identity(), static_cast<int>(i)});
  }
  return seen;
}

}  // namespace lidar_upsampling::testing
