// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {

/// What two scans tell of an object.
struct ScanLesson {
  TrackState from;         ///< at the first one, as it was taken
  TrackState state;        ///< at the second one; its step since the first
  TrackState by_scans;     ///< at the second one, if images have told of something else
  double log_odds = 0;     ///< of moving
  bool surprises = false;  ///< what was known at the first one cannot have been: it is forgotten
};

/// @brief The object's motion since its last sight, by registration of its points (where that
/// fails, by its centroid), joined with what was expected.
/// @param surface of the object in this scan.
[[nodiscard]] ScanLesson learn_from_scans(const ObjectTrack& track, const ScanObject& object,
                                          const Surface& surface, const TrackedScan& scan,
                                          const TrackOptions& options);

/// How much likelier something that moves is to look so than something that stands.
[[nodiscard]] double log_ratio_of_class(const std::string& class_name);

/// Of moving, as known at a track's last sight, when it looks like something else, perhaps.
[[nodiscard]] double log_odds_at(Stamp instant, const std::string& class_then,
                                 const ObjectTrack& track, double log_odds,
                                 const TrackOptions& options);

}  // namespace lidar_upsampling
