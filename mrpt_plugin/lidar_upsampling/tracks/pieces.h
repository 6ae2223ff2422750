// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/object_tracks.h"

/// Objects that a scan shows in pieces: buses, trucks, half-hidden cars.
namespace lidar_upsampling {

/// @brief Objects of no track, or of one that seemed parked, join the one of a seen track that
/// moves, if they lie where its points are predicted.
/// @param objects in and out.
/// @param track_of of each object, -1: none; in and out.
void join_pieces(const TrackStore& store, const TrackedScan& scan, const TrackOptions& options,
                 std::vector<ScanObject>& objects, std::vector<int>& track_of);

/// What an object may be a piece of.
struct Whole {
  TrackState state;        ///< as the piece moves, at the object's sight
  double probability = 0;  ///< that it is a piece of anything that moves
};

/// @param num_known tracks that may be the whole, the first of them.
[[nodiscard]] Whole whole_of(const ScanObject& object, const TrackedScan& scan,
                             const std::vector<ObjectTrack>& tracks, std::size_t num_known,
                             const TrackOptions& options);

}  // namespace lidar_upsampling
