// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// @brief The step of the middle of what is seen, for where nothing can be registered. Where one of
/// the scans shows more of the object, that may be at either end; where something nearer hides a
/// side, as much of a car may be behind it as is not seen, so that the middle goes aside on its
/// own.
/// @param surface of the object in this scan.
/// @return frame at rest; of the turn it tells nothing.
[[nodiscard]] PlanarStep centroid_step(const ObjectTrack& track, const ScanObject& object,
                                       const Surface& surface, const TrackedScan& scan,
                                       const TrackOptions& options);

}  // namespace lidar_upsampling
