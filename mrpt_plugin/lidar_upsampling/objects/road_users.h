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

/// "car", "truck", "person" or "pole" (posts, edges of walls) by size, "object" where that says
/// nothing.
[[nodiscard]] const char* class_by_size(const ClusterExtent& extent);

/// @brief Whether something nearer hides what lies between a cluster's lowest points and the ground
/// under it, as a car does before a van: then the cluster may well stand on the ground, while a
/// sign or a branch, under which the beams reach what is farther off, does not.
/// @param cluster indices into the scan, not empty.
[[nodiscard]] bool foot_is_hidden(const LidarScan& scan, const Ground& ground,
                                  const std::vector<int>& cluster);

}  // namespace lidar_upsampling
