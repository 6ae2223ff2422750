// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::testing {

inline Stamp at(double seconds) {
  return shifted(Stamp(mrpt::Clock::duration(133000000000000000)), seconds);
}

/// A vehicle at constant speed and yaw rate, level, starting in the origin along +X.
struct Drive {
  double speed = 10;    // m/s
  double yaw_rate = 0;  // rad/s

  [[nodiscard]] Pose pose(double t) const {
    const double yaw = yaw_rate * t;
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() =
        std::abs(yaw_rate) < 1e-9
            ? Eigen::Vector3d(speed * t, 0, 0)
            : Eigen::Vector3d(std::sin(yaw), 1 - std::cos(yaw), 0) * speed / yaw_rate;
    return pose;
  }
  [[nodiscard]] Pose step(double from, double to) const { return pose(to).inverse() * pose(from); }
};

inline double translation_between(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}

inline double angle_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

}  // namespace lidar_upsampling::testing
