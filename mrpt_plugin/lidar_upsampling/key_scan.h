// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <optional>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/scan/resample.h"
#include "lidar_upsampling/upsampler.h"

namespace lidar_upsampling {

/// The last real scan and what its images need.
struct LidarUpsampler::KeyScan {
  LidarScan scan;
  Pose T_rest_lidar_k = Pose::Identity();              ///< frame at rest: the first scan's
  std::optional<SceneSegments> segments;               ///< made at its first image
  std::unique_ptr<const SeenSpace> seen, seen_before;  ///< by it, and by the scan before it
  Stamp stamp_before;
  std::unique_ptr<const BeamResampler> resampler;  ///< where virtual scans are to lie on the beams
};

}  // namespace lidar_upsampling
