// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <optional>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/scan/resample.h"
#include "lidar_upsampling/tracks/object_tracks.h"
#include "lidar_upsampling/upsampler.h"

namespace lidar_upsampling {

/// The last real scan and what its images need.
struct LidarUpsampler::KeyScan {
  LidarScan scan;
  Pose T_rest_lidar_k = Pose::Identity();              ///< frame at rest: the first scan's
  std::optional<SceneSegments> segments;               ///< made at its first image
  std::unique_ptr<const SeenSpace> seen, seen_before;  ///< by it, and by the scan before it
  Stamp stamp_before;
  std::vector<ScanObject> objects;  ///< with tracks in the world, once they have been found
  std::vector<int> track_of;        ///< of each object, in the store
  bool objects_found = false;
  Matrix6d step_covariance = Matrix6d::Zero();     ///< of the ego-motion since the scan before
  std::unique_ptr<const BeamResampler> resampler;  ///< where virtual scans are to lie on the beams
};

/// What one image says.
struct ImageResult {
  Stamp stamp, instant;
  Camera camera;
  EgoStep ego;  ///< T_lidar_t_lidar_k
  std::vector<ObjectMotion> objects;
  std::vector<std::vector<Observation>> seen;  ///< followed points of each of the scan's objects
  std::vector<int> num_followed;               ///< of each, found or not
  std::vector<ImageView> views;                ///< of each, `share` since the scan's own instant
  std::vector<std::vector<Twist>> starts;      ///< motions that led to the points
};

}  // namespace lidar_upsampling
