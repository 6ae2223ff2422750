// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/config.h"
#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// A scan's clusters: those that may be road users, seen by a camera or not, and the others.
struct SortedClusters {
  std::vector<ScanObject> objects;
  std::vector<OtherCluster> others;
};

[[nodiscard]] SortedClusters sorted_clusters(const LidarScan& scan, const SceneSegments& segments,
                                             const Config& config);

/// @brief What lies in a detector's boxes on a picture that shows the scan.
/// @param T_camera_lidar ego-motion until the picture included.
[[nodiscard]] std::vector<ScanObject> objects_of_boxes(const LidarScan& scan,
                                                       const SceneSegments& segments,
                                                       const CameraImage& image,
                                                       const Pose& T_camera_lidar,
                                                       Detector& detector, const Config& config);

}  // namespace lidar_upsampling
