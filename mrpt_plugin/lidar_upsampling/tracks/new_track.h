// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// @brief What is assumed of an object at its first sight, which may be a piece of one that moves
/// and then moves as that does. Its sight itself is not in it yet.
/// @param num_known so many of the tracks are older than the scan.
[[nodiscard]] ObjectTrack new_track(const ScanObject& object, const TrackedScan& scan,
                                    const std::vector<ObjectTrack>& tracks, std::size_t num_known,
                                    const TrackOptions& options);

}  // namespace lidar_upsampling
