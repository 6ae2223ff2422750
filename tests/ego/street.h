// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::testing {

using Points = std::vector<Eigen::Vector3f>;

/// An upright box on wheels, its pose being that of its centre.
struct Box {
  Pose T_world_box = Pose::Identity();
  Eigen::Vector3d size = {4.2, 1.8, 1.5};
};

inline Box box_at(double x, double y, double yaw, Eigen::Vector3d size = {4.2, 1.8, 1.5}) {
  Box box;
  box.T_world_box.translation() = Eigen::Vector3d(x, y, 0.5 * size.z());
  box.T_world_box.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  box.size = size;
  return box;
}

/// A box as rays from one origin meet it.
struct SeenBox {
  SeenBox(const Box& box, const Eigen::Vector3d& origin)
      : turn(box.T_world_box.inverse().linear()),
        origin_in_box(box.T_world_box.inverse() * origin),
        half(0.5 * box.size),
        to_center(box.T_world_box.translation() - origin),
        sq_closest(to_center.squaredNorm() - half.squaredNorm() - 1e-6) {}

  /// Distance along a ray of unit length, or infinity.
  [[nodiscard]] double range_of(const Eigen::Vector3d& direction) const {
    const double along = to_center.dot(direction);
    if (along * along < sq_closest) return 1e9;  // passes the ball about it, as most do
    const Eigen::Vector3d d = turn * direction;
    double near = 0, far = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (-half[axis] - origin_in_box[axis]) / d[axis];
      const double b = (half[axis] - origin_in_box[axis]) / d[axis];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near < far && near > 0 ? near : 1e9;
  }

  Eigen::Matrix3d turn;
  Eigen::Vector3d origin_in_box, half, to_center;
  double sq_closest;
};

/// What a spinning sensor at T_world_lidar sees of flat ground (z = 0) and boxes; `owner`, if
/// given, receives the box of each point, -1 for ground.
inline LidarScan scan_street(const std::vector<Box>& boxes, const Pose& T_world_lidar,
                             unsigned seed = 1, std::vector<int>* owner = nullptr,
                             int num_rings = 48, int num_columns = 900, double noise = 0.01) {
  LidarScan scan;
  scan.num_rings = num_rings;
  scan.num_columns = num_columns;
  std::mt19937 random(seed);
  std::normal_distribution<double> error;
  const Eigen::Vector3d origin = T_world_lidar.translation();
  std::vector<SeenBox> seen;
  for (const Box& box : boxes) seen.emplace_back(box, origin);
  for (int ring = 0; ring < num_rings; ++ring) {
    const double elevation = (-24 + 27. * ring / (num_rings - 1)) * M_PI / 180;
    for (int column = 0; column < num_columns; ++column) {
      const double azimuth = 2 * M_PI * column / num_columns;
      const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth),
                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const Eigen::Vector3d direction = T_world_lidar.linear() * beam;
      double range = direction.z() < -1e-6 ? -origin.z() / direction.z() : 1e9;
      int hit = -1;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const double to_box = seen[i].range_of(direction);
        if (to_box < range) {
          range = to_box;
          hit = static_cast<int>(i);
        }
      }
      if (range < 80) {
        scan.points.emplace_back(((range + noise * error(random)) * beam).cast<float>());
        scan.ring.push_back(static_cast<std::uint16_t>(ring));
        scan.column.push_back(static_cast<std::uint16_t>(column));
        if (owner) {
          owner->push_back(hit);
        }
      }
    }
  }
  return scan;
}

/// House fronts with gaps to both sides, and poles: something to hold on to in every direction.
inline std::vector<Box> houses() {
  std::vector<Box> boxes;
  for (int i = -4; i < 8; ++i) {
    boxes.push_back(box_at(12. * i, 12 + (i % 3), 0, {9, 6, 7}));
    boxes.push_back(box_at(12. * i + 5, -13 - (i % 2), 0, {8, 6, 6}));
    boxes.push_back(box_at(12. * i + 2, 7, 0.3, {0.3, 0.3, 6}));
    boxes.push_back(box_at(12. * i + 8, -7.5, 0.1, {0.3, 0.3, 6}));
  }
  return boxes;
}

inline Pose lidar_at(double x, double y, double yaw) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 1.7);
  pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

}  // namespace lidar_upsampling::testing
