// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/objects/road_users.h"

namespace lidar_upsampling::testing {

// Positions in `segments.clusters` of what may be a road user.
inline std::vector<int> road_user_clusters(const LidarScan& scan, const SceneSegments& segments) {
  const auto why = why_no_road_users(scan, segments, {});
  std::vector<int> found;
  for (std::size_t i = 0; i < why.size(); ++i)
    if (why[i] == nullptr) found.push_back(static_cast<int>(i));
  return found;
}

}  // namespace lidar_upsampling::testing
