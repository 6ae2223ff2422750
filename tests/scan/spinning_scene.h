// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "lidar_upsampling/scan/compose.h"
#include "lidar_upsampling/scan/resample.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::testing {

constexpr int kGround = -1;
constexpr double kSensorHeight = 1.7;

/// An axis-aligned box, world frame (the lidar frame at the key scan).
struct Block {
  Eigen::Vector3d low, high;

  /// Along origin + range * direction, from outside; infinite if it is missed.
  [[nodiscard]] double range_of(const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction) const {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      double a = (low[axis] - origin[axis]) / direction[axis];
      double b = (high[axis] - origin[axis]) / direction[axis];
      if (a > b) std::swap(a, b);
      enter = std::max(enter, a);
      leave = std::min(leave, b);
    }
    return enter < leave ? enter : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] double distance_to(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d outside = (low - p).cwiseMax(p - high).cwiseMax(0);
    if (outside.norm() > 0) return outside.norm();
    return (p - low).cwiseMin(high - p).minCoeff();
  }
};

struct Spinner {
  int rings = 64, columns = 1800;
  double lowest_deg = -24, highest_deg = 3;
  double upper_half_raised_m = 0;  ///< lasers that do not sit in one point
  double noise_m = 0;

  [[nodiscard]] Eigen::Vector3d origin(int ring) const {
    return {0, 0, 2 * ring >= rings ? upper_half_raised_m : 0};
  }
  [[nodiscard]] Eigen::Vector3d direction(int ring, int column) const {
    const double elevation =
        (lowest_deg + (highest_deg - lowest_deg) * ring / (rings - 1)) * M_PI / 180;
    const double azimuth = M_PI - 2 * M_PI * (column + 0.5) / columns;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
  }
};

/// A scan, and what each point lies on: the position of a block, or kGround.
struct LabelledScan {
  LidarScan scan;
  std::vector<int> surface;
};

inline LabelledScan scan_of(const std::vector<Block>& blocks, const Spinner& spinner,
                            const Pose& T_world_lidar = Pose::Identity()) {
  constexpr double kMaxRange = 80;
  LabelledScan result;
  LidarScan& scan = result.scan;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1);
  for (int ring = 0; ring < spinner.rings; ++ring)
    for (int column = 0; column < spinner.columns; ++column) {
      const Eigen::Vector3d origin = T_world_lidar * spinner.origin(ring);
      const Eigen::Vector3d beam = spinner.direction(ring, column);
      const Eigen::Vector3d direction = T_world_lidar.linear() * beam;
      double range = direction.z() < 0 ? (-kSensorHeight - origin.z()) / direction.z()
                                       : std::numeric_limits<double>::infinity();
      int surface = kGround;
      for (int i = 0; i < static_cast<int>(blocks.size()); ++i)
        if (const double r = blocks[i].range_of(origin, direction); r < range) {
          range = r;
          surface = i;
        }
      if (range > kMaxRange) continue;
      range += spinner.noise_m * noise(random);
      scan.points.emplace_back((spinner.origin(ring) + range * beam).cast<float>());
      scan.intensity.push_back(surface == kGround ? 0.25F : 0.5F);
      scan.ring.push_back(static_cast<std::uint16_t>(ring));
      scan.column.push_back(static_cast<std::uint16_t>(column));
      scan.time_s.push_back(static_cast<float>(column) * 1e-4F);
      result.surface.push_back(surface);
    }
  scan.label = "LIDAR";
  scan.num_rings = spinner.rings;
  scan.num_columns = spinner.columns;
  return result;
}

/// The virtual scan of a sensor moved to `T_world_lidar_t`, one block moved by `shift`.
inline VirtualScan moved_scan(const LabelledScan& key, const Pose& T_world_lidar_t,
                              int moving_block = kGround,
                              const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  ScanMotion motion;
  motion.stamp = shifted(key.scan.stamp, 0.1);
  motion.T_lidar_t_lidar_k = T_world_lidar_t.inverse();
  if (moving_block != kGround) {
    ObjectMotion object;
    object.track_id = 7;
    object.status = MotionStatus::moving;
    object.T_lidar_t_lidar_k = T_world_lidar_t.inverse() * Eigen::Translation3d(shift);
    for (int i = 0; i < static_cast<int>(key.scan.size()); ++i)
      if (key.surface[i] == moving_block) object.points.push_back(i);
    motion.objects.push_back(object);
  }
  return compose_virtual_scan(key.scan, motion, "LIDAR_VIRTUAL", {});
}

/// A resampled scan, and what was done to it.
struct Resampled {
  VirtualScan scan;
  Resampling status;
};

inline Resampled resample_on_beams(const LidarScan& key, VirtualScan moved) {
  Resampled result{BeamResampler(key).resample(std::move(moved)), Resampling::none};
  result.status = result.scan.resampling;
  return result;
}

inline Pose driven(double forward, double left, double yaw_deg) {
  return Eigen::Translation3d(forward, left, 0) *
         Pose(Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitZ()));
}

/// Points by ring and column.
inline std::map<std::pair<int, int>, int> by_beam(const LidarScan& scan) {
  std::map<std::pair<int, int>, int> points;
  for (int i = 0; i < static_cast<int>(scan.size()); ++i)
    points[{scan.ring[i], scan.column[i]}] = i;
  return points;
}

}  // namespace lidar_upsampling::testing
