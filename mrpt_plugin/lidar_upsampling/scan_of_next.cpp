// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan_of_next.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

constexpr int kNobody = -1;
constexpr float kReach_m = 0.3F;  // of an object's points, from where they will be
constexpr double kMostly = 0.3;   // share of a cluster that speaks for all of it

// The scan's points above the ground that `belongs` says, with all of the clusters that mostly do.
template <typename Belongs>
std::vector<int> with_their_clusters(const PreparedScan& next, Belongs belongs) {
  const SceneSegments& segments = next.segments;
  const bool has_ground = segments.ground.status == GroundStatus::found;
  std::vector<int> points, count(segments.clusters.size(), 0);
  for (int i = 0; i < static_cast<int>(next.scan.size()); ++i) {
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

// Those that show the object.
std::vector<int> points_of(const ObjectMotion& object, const Pose& T_next_k,
                           const LidarScan& key_scan, const PreparedScan& next) {
  std::vector<Eigen::Vector3f> places;
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& point : points_at(key_scan, object.points)) {
    places.emplace_back(T_next_k.cast<float>() * point);
    bounds.extend(places.back());
  }
  bounds.min().array() -= kReach_m;
  bounds.max().array() += kReach_m;
  const PointIndex index(std::move(places));
  return with_their_clusters(next, [&](int i) {
    const Eigen::Vector3f& point = next.scan.points[i];
    return bounds.contains(point) && index.nearest(point, kReach_m * kReach_m).index >= 0;
  });
}

}  // namespace

ScanMotion motion_of_next(const PreparedScan& next, const ScanMotion& of_key,
                          const LidarScan& key_scan, const SeenSpace& seen_k) {
  const double share = seconds_between(key_scan.stamp, next.scan.stamp) /
                       seconds_between(key_scan.stamp, of_key.stamp);
  ScanMotion motion;
  motion.stamp = of_key.stamp;
  motion.cameras = of_key.cameras;
  motion.T_lidar_t_lidar_k = of_key.T_lidar_t_lidar_k * next.T_scan_before.inverse();
  std::vector<int> owner(next.scan.size(), kNobody);
  for (const ObjectMotion& object : of_key.objects) {
    if (!moves(object)) continue;
    const Pose T_next_k = next.T_scan_before * exp_se3(Twist(log_se3(object.T_mov) * share));
    ObjectMotion back = object;
    back.T_lidar_t_lidar_k = object.T_lidar_t_lidar_k * T_next_k.inverse();
    back.points = points_of(object, T_next_k, key_scan, next);
    for (const int i : back.points) owner[i] = object.track_id;
    motion.objects.push_back(std::move(back));
  }
  const Eigen::Isometry3f T_k_next = next.T_scan_before.inverse().cast<float>();
  for (const int i : with_their_clusters(next, [&](int i) {
         return owner[i] == kNobody &&
                seen_k.at(T_k_next * next.scan.points[i]) == Sight::seen_through;
       }))
    if (owner[i] == kNobody) motion.left_out.push_back(i);
  return motion;
}

}  // namespace lidar_upsampling
