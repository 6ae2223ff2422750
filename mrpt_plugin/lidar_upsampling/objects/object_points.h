// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

struct ObjectPointOptions {
  ClusterOptions clusters;  ///< the angle between rings is taken from the segments
  int min_points = 8;
  double box_margin = 0.05;  ///< of the box's size, on each side, by which a box may be too small
  double min_overlap = 0.1;  ///< IoU of the box with the cluster's own
  double min_share = 0.6;  ///< the scene's cluster is taken, with its points outside the box, if so
                           ///< much of either is common to both
};

/// @brief The points of the object in a 2D box (paper, section "Defining Object Points"): ground
/// left out, Euclidean clusters in the box's frustum, of which that is the object's which fills the
/// box best, has most points, and is nearest to its centre and the camera.
/// @param visible the scan on the picture, without hidden points.
/// @return indices into the scan, ascending; none if no cluster fits the box.
[[nodiscard]] std::optional<std::vector<int>> select_object_points(
    const LidarScan& scan, const std::vector<ProjectedPoint>& visible,
    const SceneSegments& segments, const Box2d& box, const ObjectPointOptions& options = {});

}  // namespace lidar_upsampling
