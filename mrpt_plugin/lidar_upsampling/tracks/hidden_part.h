// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// @brief Whether most of an object lies behind something nearer, or where the sensor does not
/// look.
/// @param places of its points, lidar frame.
[[nodiscard]] bool is_hidden(const SeenSpace& seen, const std::vector<Eigen::Vector3f>& places);

/// @brief What earlier sights have shown of an object and something nearer hides now, lidar frame
/// now. What its own front hides is left out: none will look for it there.
/// @param track before the sight.
/// @param now its state at the sight.
[[nodiscard]] std::vector<Eigen::Vector3f> hidden_part(const ObjectTrack& track,
                                                       const TrackState& now,
                                                       const ScanObject& object,
                                                       const TrackedScan& scan);

}  // namespace lidar_upsampling
