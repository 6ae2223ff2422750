// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct TrackerOptions {
  double min_overlap = 0.15;        ///< IoU with the predicted box, where 3D says nothing
  double max_distance = 2;          ///< m, from the predicted centroid...
  double max_acceleration = 8;      ///< m/s^2, ...plus what this adds since the last sight
  double class_change_cost = 0.25;  ///< added to a cost of 0 (same place) to 1
  double size_change_cost = 0.25;   ///< likewise, each time the size seen is doubled or halved
  int max_misses = 3;               ///< images in a row without a detection
};

/// Where the scan shows an object, in the caller's frame at rest.
struct Place {
  Eigen::Vector3d centroid;
  double size = 0;  ///< of what is seen, in any unit that goes with its area; 0: unknown
};

/// An object over time, on one camera. Centroid and velocity are in the caller's frame at rest.
struct Track {
  int id = -1;
  int external_id = -1;  ///< the detector's own identity, -1 if none
  std::string class_name;
  Stamp stamp;  ///< of its last detection
  Box2d box;    ///< at `stamp`
  std::optional<Place> place;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector4d box_rate = Eigen::Vector4d::Zero();  ///< px/s of left, top, right, bottom
  int age = 1;                                         ///< detections so far
  int misses = 0;                                      ///< images since the last one
};

/// Where the caller knows a track to be by now, e.g. from its tracked points.
struct TrackPrediction {
  Box2d box;
  std::optional<Eigen::Vector3d> centroid;
};

[[nodiscard]] double intersection_over_union(const Box2d& a, const Box2d& b);

/// @brief Gives detections identities: one tracker per camera. Each track is predicted (by the
/// caller, or at constant velocity), the assignment of least cost joins detections to tracks.
class Tracker {
 public:
  /// @param next_id counter of track ids, shared by the trackers of all cameras; it outlives them.
  Tracker(const TrackerOptions& options, int& next_id) : options_(options), next_id_(&next_id) {}

  /// @param places one per detection, or empty: that of its points, where known.
  /// @param predictions by track id; tracks without one move at constant velocity.
  /// @return the track id of each detection, new ones included.
  /// @throw std::invalid_argument as many places as detections, or none, were expected.
  std::vector<int> update(Stamp stamp, const std::vector<Detection>& detections,
                          const std::vector<std::optional<Place>>& places = {},
                          const std::map<int, TrackPrediction>& predictions = {});

  /// Alive tracks, by id.
  [[nodiscard]] const std::vector<Track>& tracks() const { return tracks_; }

 private:
  TrackerOptions options_;
  int* next_id_;
  std::vector<Track> tracks_;
};

}  // namespace lidar_upsampling
