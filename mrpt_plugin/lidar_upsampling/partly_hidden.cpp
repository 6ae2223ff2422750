// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/partly_hidden.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/tracks/hidden_part.h"

namespace lidar_upsampling {
namespace {

constexpr double kMostly = 0.3;  // share of a cluster that speaks for all of it

}  // namespace

std::vector<int> with_their_clusters(const PreparedScan& scan,
                                     const std::function<bool(int)>& belongs) {
  const SceneSegments& segments = scan.segments;
  const bool has_ground = segments.ground.status == GroundStatus::found;
  std::vector<int> points, count(segments.clusters.size(), 0);
  for (int i = 0; i < static_cast<int>(scan.scan.size()); ++i) {
    if ((has_ground && segments.ground.is_ground[i] != 0) || !belongs(i)) continue;
    points.push_back(i);
    if (const int cluster = segments.cluster_of[i]; cluster >= 0) ++count[cluster];
  }
  const auto is_whole = [&](int cluster) {
    return cluster >= 0 &&
           count[cluster] >= kMostly * static_cast<double>(segments.clusters[cluster].size());
  };
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](int i) { return is_whole(segments.cluster_of[i]); }),
               points.end());
  for (int cluster = 0; cluster < static_cast<int>(count.size()); ++cluster)
    if (count[cluster] > 0 && is_whole(cluster))
      points.insert(points.end(), segments.clusters[cluster].begin(),
                    segments.clusters[cluster].end());
  return points;
}

std::vector<int> points_near(const PreparedScan& scan, std::vector<Eigen::Vector3f> places,
                             const std::function<bool(int)>& may_belong) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& place : places) bounds.extend(place);
  bounds.min().array() -= kReach_m;
  bounds.max().array() += kReach_m;
  const PointIndex index(std::move(places));
  return with_their_clusters(scan, [&](int i) {
    const Eigen::Vector3f& point = scan.scan.points[i];
    return bounds.contains(point) && may_belong(i) &&
           index.nearest(point, kReach_m * kReach_m).index >= 0;
  });
}

void take_up_hidden(PreparedScan& scan, TrackStore& store, std::vector<int>& track_of,
                    const TrackOptions& options) {
  std::vector<bool> is_taken(scan.scan.size(), false), is_seen(store.tracks.size(), false);
  const auto take = [&](const ScanObject& object) {
    for (const int i : object.points) is_taken[i] = true;
  };
  std::for_each(scan.objects.begin(), scan.objects.end(), take);
  for (const int track : track_of) is_seen[track] = true;
  for (std::size_t i = 0; i < store.tracks.size(); ++i) {
    ObjectTrack& track = store.tracks[i];
    if (is_seen[i] || !is_mover(track, options)) continue;
    TrackState now = predicted(track.latest, scan.scan.stamp, options.noise);
    const auto shown = [&](std::vector<Eigen::Vector3f> places) {
      return is_known_within(now, kReach_m)
                 ? points_near(scan, std::move(places), [&](int j) { return !is_taken[j]; })
                 : std::vector<int>{};
    };
    std::vector<Eigen::Vector3f> places = points_by(track, now, scan.T_rest_lidar);
    const bool hides = is_hidden(*scan.seen, places) && is_known_within(now, 0.5 * track.length);
    ScanObject object;
    object.points = shown(std::move(places));
    if (scan.is_sweep && !object.points.empty()) {  // where it was when the sweep met it
      object.time_s = mean_time(scan.scan.time_s, object.points);
      now = predicted(track.latest, shifted(scan.scan.stamp, object.time_s), options.noise);
      object.points = shown(points_by(track, now, scan.T_rest_lidar));
    }
    if (object.points.empty() && !hides) continue;
    object.class_name = track.class_name;
    object.external_id = track.external_id;
    object.length = track.length;
    take(object);
    go_on(track, now, scan.T_rest_lidar, options);
    object.centroid = object.points.empty() ? scan.T_rest_lidar.inverse() * track.centroid_rest
                                            : mean_of(points_at(scan.scan, object.points));
    scan.objects.push_back(std::move(object));
    track_of.push_back(static_cast<int>(i));
  }
}

}  // namespace lidar_upsampling
