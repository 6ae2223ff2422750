// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::testing {

/// An upright box; `truth` of its points.
struct BoxObject {
  Eigen::Vector3d center;  ///< of the footprint, z of its underside
  double length, width, height, yaw;
};

constexpr int kOnGround = -1;

/// A scan from the origin, 1.8 m above the ground under it, and what each point lies on.
struct Street {
  LidarScan scan;
  std::vector<int> truth;  ///< index of the box, or kOnGround
};

/// A box as rays from the origin meet it.
struct SeenBox {
  explicit SeenBox(const BoxObject& box)
      : turn(Eigen::AngleAxisd(-box.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix()),
        origin(turn * (-box.center)),
        low(-box.length / 2, -box.width / 2, 0),
        high(box.length / 2, box.width / 2, box.height) {}

  /// Distance along the ray, infinity if it misses.
  [[nodiscard]] double range_of(const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d direction = turn * ray;
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low[axis] - origin[axis]) / direction[axis];
      const double b = (high[axis] - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave && enter > 0 ? enter : std::numeric_limits<double>::infinity();
  }

  Eigen::Matrix3d turn;
  Eigen::Vector3d origin, low, high;
};

/// `ground(x, y)` is the height of the ground, in the lidar frame, nowhere as steep as one in one;
/// rays march to it.
inline Street make_street(const std::function<double(double, double)>& ground,
                          const std::vector<BoxObject>& boxes, int num_rings = 64,
                          int num_columns = 1200, double noise = 0.015) {
  Street street;
  street.scan.num_rings = num_rings;
  street.scan.num_columns = num_columns;
  std::mt19937 generator(7);
  std::normal_distribution<double> jitter;
  const std::vector<SeenBox> seen(boxes.begin(), boxes.end());
  for (int ring = 0; ring < num_rings; ++ring) {
    const double elevation = (-24.8 + 26.8 * ring / (num_rings - 1)) * M_PI / 180;
    for (int column = 0; column < num_columns; ++column) {
      const double azimuth = 2 * M_PI * (column + 0.5) / num_columns;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      double range = std::numeric_limits<double>::infinity();
      int hit = kOnGround;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const double to_box = seen[i].range_of(ray);
        if (to_box < range) {
          range = to_box;
          hit = static_cast<int>(i);
        }
      }
      const double end = std::min(range, 90.);
      for (int step = 40; 0.05 * step < end; ++step) {
        const double r = 0.05 * step;
        const double above = r * ray.z() - ground(r * ray.x(), r * ray.y());
        if (above > 0) {
          step += static_cast<int>(above / (2 * 0.05));  // from where it could be met at once
          continue;
        }
        range = r;
        hit = kOnGround;
        break;
      }
      if (!(range < 90)) continue;
      street.scan.points.emplace_back(((range + noise * jitter(generator)) * ray).cast<float>());
      street.scan.ring.push_back(static_cast<std::uint16_t>(ring));
      street.scan.column.push_back(static_cast<std::uint16_t>(column));
      street.truth.push_back(hit);
    }
  }
  return street;
}

inline double flat(double /*x*/, double /*y*/) { return -1.8; }

/// Looks along +X of the lidar, from its place.
inline Pose forward_camera() {
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return T_camera_lidar;
}

inline Camera wide_camera(const std::string& label = "CAM") {
  Camera camera;
  camera.label = label;
  camera.model.width = 1242;
  camera.model.height = 375;
  camera.model.fx = camera.model.fy = 721;
  camera.model.cx = 609;
  camera.model.cy = 172;
  return camera;
}

}  // namespace lidar_upsampling::testing
