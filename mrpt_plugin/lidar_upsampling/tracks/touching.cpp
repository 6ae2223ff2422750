// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/touching.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "lidar_upsampling/objects/cluster_extent.h"
#include "lidar_upsampling/registration/voxel_grid.h"

namespace lidar_upsampling {
namespace {

constexpr int kLeastPoints = 8;  // as of a cluster

/// A track that moves, or stands, for certain, with the state that it has when an object was seen.
struct Claim {
  const ObjectTrack* track;
  TrackState now;
  bool moves;
  Eigen::Isometry3f T_then_lidar = Eigen::Isometry3f::Identity();
};

bool stands(const ObjectTrack& track, const TrackOptions& options) {
  return track.latest_log_odds < -std::log(options.loss_ratio);
}

/// @param step of the track since its last sight, level.
bool is_near(const ObjectTrack& track, const Eigen::Vector2d& step, const ScanObject& object,
             const Pose& T_rest_lidar) {
  const Eigen::Translation3d moved(step.x(), step.y(), 0);
  return (moved * track.centroid_rest - T_rest_lidar * object.centroid).norm() <
         (object.length + track.whole_length) / 2 + kReach_m;
}

/// Those who may have a part in the object, movers first.
std::vector<Claim> claims_on(const ScanObject& object, const TrackStore& store,
                             const TrackedScan& scan, const TrackOptions& options) {
  std::vector<Claim> claims;
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  for (const ObjectTrack& track : store.tracks) {
    if (!is_mover(track, options)) continue;
    const TrackState now = predicted(track.latest, instant, options.noise);
    if (is_near(track, now.mean.head<2>(), object, scan.T_rest_lidar) &&
        is_predictable(track, now, options))
      claims.push_back({&track, now, true});
  }
  for (const ObjectTrack& track : store.tracks) {
    if (!stands(track, options) ||
        !is_near(track, Eigen::Vector2d::Zero(), object, scan.T_rest_lidar))
      continue;
    claims.push_back({&track, track.latest, false});
    claims.back().now.mean.head<3>().setZero();
  }
  return claims;
}

bool move_alike(const Claim& a, const Claim& b) {
  constexpr double kSurely = 9.2;  // chi-squared of two dimensions: in one case of a hundred
  if (!a.moves || !b.moves) return a.moves == b.moves;
  const Eigen::Vector2d astray = a.now.velocity() - b.now.velocity();
  const Eigen::Matrix2d P = a.now.covariance.block<2, 2>(3, 3) + b.now.covariance.block<2, 2>(3, 3);
  return astray.dot(P.inverse() * astray) < kSurely;
}

/// Which motion each claim has: 0, 1, ...
std::vector<int> motions_of(const std::vector<Claim>& claims) {
  std::vector<int> motion_of(claims.size());
  int num_motions = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    std::size_t like = 0;
    while (!move_alike(claims[i], claims[like])) ++like;
    motion_of[i] = like == i ? num_motions++ : motion_of[like];
  }
  return motion_of;
}

bool all_alike(const std::vector<int>& motion_of) {
  return std::count(motion_of.begin(), motion_of.end(), 0) == static_cast<long>(motion_of.size());
}

/// Squared distances of places from where each motion's surfaces are predicted.
using Distances = std::vector<std::vector<float>>;

/// @param places lidar frame. @param far what is farther lies as far as that.
Distances distances(const std::vector<Eigen::Vector3f>& places, const std::vector<Claim>& claims,
                    const std::vector<int>& motion_of, float far) {
  const int num_motions = 1 + *std::max_element(motion_of.begin(), motion_of.end());
  Distances result(num_motions, std::vector<float>(places.size(), far));
  for (std::size_t c = 0; c < claims.size(); ++c) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      float& least = result[motion_of[c]][i];
      const Eigen::Vector3f then = claims[c].T_then_lidar * places[i];
      least = std::min(least, claims[c].track->surface->nearest(then, least).sq_distance);
    }
  }
  return result;
}

/// The motion that is nearest to a place.
std::size_t nearest(const Distances& distances, std::size_t place) {
  std::size_t best = 0;
  for (std::size_t m = 1; m < distances.size(); ++m)
    if (distances[m][place] < distances[best][place]) best = m;
  return best;
}

/// Whether enough points lie on each motion.
/// @param place_of each point.
std::vector<bool> are_seen(const Distances& distances, const std::vector<int>& place_of) {
  std::vector<int> count(distances.size(), 0);
  for (const int place : place_of) {
    const std::size_t motion = nearest(distances, place);
    count[motion] += static_cast<int>(distances[motion][place] < kReach_m * kReach_m);
  }
  std::vector<bool> result;
  result.reserve(count.size());
  for (const int points : count) result.push_back(points >= kLeastPoints);
  return result;
}

ScanObject part_of(const ScanObject& whole, std::vector<int> points, const LidarScan& scan) {
  ScanObject part;
  const ClusterExtent extent = cluster_extent(scan.points, {}, points);
  part.centroid = extent.centroid.cast<double>();
  part.length = extent.length;
  part.class_name = whole.class_name;
  if (whole.time_s != 0) part.time_s = mean_time(scan.time_s, points);
  part.points = std::move(points);
  return part;
}

std::vector<ScanObject> parts_of(const ScanObject& object, std::vector<Claim>& claims,
                                 const TrackedScan& scan) {
  for (Claim& claim : claims)
    claim.T_then_lidar = from_sight(*claim.track, claim.now, scan.T_rest_lidar).inverse();
  const std::vector<int> motion_of = motions_of(claims);
  if (all_alike(motion_of)) return {};
  // Surfaces are no finer.
  const VoxelGroups cubes = group_by_voxel(points_at(scan.scan, object.points), kFine_m);
  // Most are asked in vain: what is far is looked for only where two are near.
  constexpr float kNear = kReach_m * kReach_m, kAny = std::numeric_limits<float>::max();
  Distances to = distances(cubes.means, claims, motion_of, kNear);
  const std::vector<bool> is_seen = are_seen(to, cubes.of_point);
  if (std::count(is_seen.begin(), is_seen.end(), true) < 2) return {};
  to = distances(cubes.means, claims, motion_of, kAny);
  for (std::size_t m = to.size(); m-- > 0;)
    if (!is_seen[m]) to.erase(to.begin() + static_cast<long>(m));
  std::vector<std::vector<int>> points(to.size());
  for (std::size_t i = 0; i < object.points.size(); ++i)
    points[nearest(to, cubes.of_point[i])].push_back(object.points[i]);
  std::vector<ScanObject> parts;
  parts.reserve(points.size());
  for (auto& some : points) parts.push_back(part_of(object, std::move(some), scan.scan));
  return parts;
}

}  // namespace

void part_touching(const TrackStore& store, const TrackedScan& scan, const TrackOptions& options,
                   std::vector<ScanObject>& objects) {
  std::vector<std::vector<ScanObject>> parts(objects.size());
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    if (objects[i].external_id >= 0) return;  // the detector has parted it
    std::vector<Claim> claims = claims_on(objects[i], store, scan, options);
    parts[i] = parts_of(objects[i], claims, scan);
  });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    objects[i] = std::move(parts[i].front());
    std::move(parts[i].begin() + 1, parts[i].end(), std::back_inserter(objects));
  }
}

}  // namespace lidar_upsampling
