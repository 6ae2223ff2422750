// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/tracks/log_odds.h"

namespace lidar_upsampling {
namespace {

/// The detector parts objects that it has seen itself.
bool are_parted(const ObjectTrack& track, const ScanObject& object) {
  return track.external_id >= 0 && object.external_id >= 0;
}

bool is_far(const ObjectTrack& track, const TrackState& now, const ScanObject& object,
            const Pose& T_rest_lidar) {
  constexpr double kFar_m = 3;  // four sigmas of the gap: saves work, tells nothing else
  const Eigen::Translation3d step(now.mean[0], now.mean[1], 0);
  return (step * track.centroid_rest - T_rest_lidar * object.centroid).norm() >
         object.length + track.length + kFar_m;
}

/// The share of the object's points that lie where some points are predicted.
double share_at(const PointIndex& places, const ScanObject& object, const LidarScan& scan) {
  constexpr std::size_t kEnough = 60;  // points that tell the share
  const std::size_t stride = 1 + object.points.size() / kEnough;
  int asked = 0, near = 0;
  for (std::size_t i = 0; i < object.points.size(); i += stride, ++asked)
    near += places.nearest(scan.points[object.points[i]], kReach_m * kReach_m).index >= 0;
  return static_cast<double>(near) / asked;
}

void join(const ScanObject& piece, ScanObject& whole) {
  const auto of_piece = static_cast<double>(piece.points.size());
  const double share = of_piece / (of_piece + static_cast<double>(whole.points.size()));
  const double apart = (piece.centroid - whole.centroid).norm();
  whole.centroid += share * (piece.centroid - whole.centroid);
  whole.time_s += share * (piece.time_s - whole.time_s);
  whole.length =
      std::max({piece.length, whole.length, apart + 0.5 * (piece.length + whole.length)});
  whole.points.insert(whole.points.end(), piece.points.begin(), piece.points.end());
}

/// Between an object and where a track's points are by now if it moves, m.
double gap_between(const ScanObject& object, const std::vector<Eigen::Vector3f>& places,
                   const LidarScan& scan) {
  float sq_gap = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& place : places)
    for (const int i : object.points)
      sq_gap = std::min(sq_gap, (scan.points[i] - place).head<2>().squaredNorm());
  return std::sqrt(sq_gap);
}

/// Density (1/m^2) of the object as a piece of what moves.
double piece_density(const ScanObject& object, const ObjectTrack& track, const TrackedScan& scan,
                     const TrackOptions& options) {
  constexpr double kGap_m = 0.7;  // between pieces
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  const TrackState now = predicted(track.latest, instant, options.noise);
  if (are_parted(track, object) || is_far(track, now, object, scan.T_rest_lidar)) return 0;
  const double gap =
      gap_between(object, points_by(track, now, scan.T_rest_lidar), scan.scan) / kGap_m;
  const double length = std::max({kCar_m, track.length, object.length});
  return options.piece_share * probability_of(track.log_odds) * probability_of_being_there(track) *
         std::exp(-0.5 * gap * gap) / (length * length);
}

}  // namespace

void join_pieces(const TrackStore& store, const TrackedScan& scan, const TrackOptions& options,
                 std::vector<ScanObject>& objects, std::vector<int>& track_of) {
  constexpr double kMost = 0.5;
  const std::vector<int> known = track_of;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] < 0) continue;
    const ObjectTrack& track = store.tracks[known[i]];
    const Stamp instant = shifted(scan.scan.stamp, objects[i].time_s);
    const TrackState now = predicted(track.latest, instant, options.noise);
    if (!is_predictable(track, now, options)) continue;
    std::optional<PointIndex> places;
    for (std::size_t j = 0; j < objects.size(); ++j) {
      if ((known[j] >= 0 && is_mover(store.tracks[known[j]], options)) ||
          objects[j].points.empty() || are_parted(track, objects[j]) ||
          is_far(track, now, objects[j], scan.T_rest_lidar))
        continue;
      if (!places) places.emplace(points_by(track, now, scan.T_rest_lidar));
      if (share_at(*places, objects[j], scan.scan) < kMost) continue;
      join(objects[j], objects[i]);
      objects[j].points.clear();
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].points.empty()) continue;
    if (kept != i) objects[kept] = std::move(objects[i]);
    track_of[kept++] = track_of[i];
  }
  objects.resize(kept);
  track_of.resize(kept);
}

Whole whole_of(const ScanObject& object, const TrackedScan& scan,
               const std::vector<ObjectTrack>& tracks, std::size_t num_known,
               const TrackOptions& options) {
  Whole whole;
  double most = 0;
  for (std::size_t i = 0; i < num_known; ++i) {
    const double here = piece_density(object, tracks[i], scan, options);
    if (here <= most) continue;
    most = here;
    const Stamp instant = shifted(scan.scan.stamp, object.time_s);
    whole.state = from_here(predicted(tracks[i].state, instant, options.noise));
    whole.state.stamp = instant;
  }
  whole.probability = most / (most + options.birth_density);
  return whole;
}

}  // namespace lidar_upsampling
