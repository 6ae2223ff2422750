// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/objects/cluster_extent.h"
#include "lidar_upsampling/objects/clusters.h"
#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct SegmentOptions {
  GroundOptions ground;
  ClusterOptions clusters;  ///< the angles between beams are taken from the scan
  double max_range = 120;   ///< m, farther points are left alone
  double max_height = 4;    ///< m above the ground, higher ones too
};

/// The ground of a scan, and what stands on it.
struct SceneSegments {
  Ground ground;
  std::vector<std::vector<int>> clusters;     ///< indices into the scan, the largest first
  std::vector<int> cluster_of;                ///< of each point of the scan, -1 for none
  std::vector<ClusterExtent> extents;         ///< of each cluster
  double vertical_step_deg = 0.4;             ///< between the scan's rings
  std::optional<double> horizontal_step_deg;  ///< between its columns, where it has any
};

/// @brief Ground and clusters of a scan; done once per key scan.
[[nodiscard]] SceneSegments segment_scan(const LidarScan& scan, const SegmentOptions& options = {});

}  // namespace lidar_upsampling
