// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <vector>

#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/scan/resample.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// How the vehicle goes on.
struct SteadyMotion {
  Twist rate = Twist::Zero();  ///< per second, lidar frame
  bool is_measured = false;    ///< between two scans; else hoped for, or from a picture
};

/// A real scan and what is known of it, the same whether it is the last one, the key scan or to
/// come.
struct PreparedScan {
  LidarScan scan;  ///< all points at its stamp, in level axes (level_frame.h)
  Eigen::Matrix3d R_level_lidar = Eigen::Matrix3d::Identity();  ///< to these from the LiDAR's own
  bool is_sweep = false;  ///< what moves on its own was seen at the instants that `time_s` tells
  Pose T_rest_lidar = Pose::Identity();            ///< frame at rest: the first scan's
  Pose T_scan_before = Pose::Identity();           ///< ego-motion since the scan before
  Matrix6d step_covariance = Matrix6d::Zero();     ///< of it, a left increment
  SteadyMotion motion;                             ///< as since the scan before
  SceneSegments segments;                          ///< ground and clusters
  std::shared_ptr<const SeenSpace> seen;           ///< free space
  std::unique_ptr<const BeamResampler> resampler;  ///< where virtual scans are to lie on the beams
  std::vector<ScanObject> objects;                 ///< candidates
  std::vector<OtherCluster> other_clusters;        ///< until a virtual scan has told of them

  [[nodiscard]] TrackedScan tracked() const { return {scan, T_rest_lidar, step_covariance, seen}; }
};

}  // namespace lidar_upsampling
