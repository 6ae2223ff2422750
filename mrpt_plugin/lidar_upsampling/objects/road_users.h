// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/objects/detector.h"

namespace lidar_upsampling {

/// @brief Of each cluster of a scan why it can be no road user, by its size and where it stands, as
/// a word; null: it may be one.
[[nodiscard]] std::vector<const char*> why_no_road_users(const LidarScan& scan,
                                                         const SceneSegments& segments,
                                                         const ClusterDetectorOptions& options);

/// @brief The clusters of a scan that may be road users, by their size and where they stand; seen
/// by a camera or not.
/// @return positions in `segments.clusters`.
[[nodiscard]] std::vector<int> road_user_clusters(const LidarScan& scan,
                                                  const SceneSegments& segments,
                                                  const ClusterDetectorOptions& options);

/// "car", "truck" or "person" by size, "object" where that says nothing.
[[nodiscard]] const char* class_by_size(const ClusterExtent& extent);

}  // namespace lidar_upsampling
