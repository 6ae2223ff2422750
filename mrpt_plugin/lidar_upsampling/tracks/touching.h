// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// @brief Parts what a scan shows as one where tracks of different motions touch: a car that passes
/// a parked one, people who meet. The points of each cube of kFine_m go to the motion whose surface
/// is predicted nearest.
/// @param objects in and out; a new one for each motion more.
void part_touching(const TrackStore& store, const TrackedScan& scan, const TrackOptions& options,
                   std::vector<ScanObject>& objects);

}  // namespace lidar_upsampling
