// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <vector>

#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling::testing {

/// Nothing is known of it.
inline std::shared_ptr<const SeenSpace> unknown_space() {
  return std::make_shared<const SeenSpace>(std::vector<Eigen::Vector3f>{}, 0.4);
}

/// A scan of a sensor at rest, and its objects; free space is not known.
struct ObjectsScan {
  std::vector<int> take_up(TrackStore& store) {
    return take_up_scan(store, objects, {scan, T_rest_lidar, step_covariance, seen}, {});
  }

  LidarScan scan;
  std::vector<ScanObject> objects;
  Pose T_rest_lidar = Pose::Identity();
  Matrix6d step_covariance = Matrix6d::Zero();
  std::shared_ptr<const SeenSpace> seen = unknown_space();
};

}  // namespace lidar_upsampling::testing
