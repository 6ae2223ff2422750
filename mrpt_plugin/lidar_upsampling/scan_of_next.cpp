// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan_of_next.h"

#include <utility>

#include "lidar_upsampling/partly_hidden.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

constexpr int kNobody = -1;

// Those that show the object.
std::vector<int> points_of(const ObjectMotion& object, const Pose& T_next_k,
                           const LidarScan& key_scan, const PreparedScan& next) {
  std::vector<Eigen::Vector3f> places;
  for (const Eigen::Vector3f& point : points_at(key_scan, object.points))
    places.emplace_back(T_next_k.cast<float>() * point);
  return points_near(next, std::move(places), [](int) { return true; });
}

}  // namespace

ScanMotion motion_of_next(const PreparedScan& next, const ScanMotion& of_key,
                          const LidarScan& key_scan, const SeenSpace& seen_k) {
  const double dt = seconds_between(key_scan.stamp, next.scan.stamp);
  ScanMotion motion;
  motion.stamp = of_key.stamp;
  motion.cameras = of_key.cameras;
  motion.T_lidar_t_lidar_k = of_key.T_lidar_t_lidar_k * next.T_scan_before.inverse();
  std::vector<int> owner(next.scan.size(), kNobody);
  for (const ObjectMotion& object : of_key.objects) {
    if (!moves(object) || object.points.empty()) continue;
    const Pose T_next_k = next.T_scan_before * exp_se3(Twist(object.rate_lidar_k * dt));
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
