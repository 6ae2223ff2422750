// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/compose.h"

#include <map>
#include <utility>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr int kNobody = -1;

// For each point of the key scan, the object that moves it: its position in `objects`, or kNobody.
std::vector<int> owners_of_points(std::size_t num_points,
                                  const std::vector<ObjectMotion>& objects) {
  std::vector<int> owner(num_points, kNobody);
  for (int i = 0; i < static_cast<int>(objects.size()); ++i)
    for (const int point : objects[i].points) {
      int& current = owner[point];
      if (current == kNobody || objects[current].num_inliers < objects[i].num_inliers) current = i;
    }
  return owner;
}

std::vector<Eigen::Isometry3f> transforms_of(const Pose& T_lidar_t_lidar_k,
                                             const std::vector<ObjectMotion>& objects) {
  std::vector<Eigen::Isometry3f> transforms{T_lidar_t_lidar_k.cast<float>()};
  for (const ObjectMotion& object : objects)
    transforms.push_back(object.T_lidar_t_lidar_k.cast<float>());
  return transforms;
}

// Which points of the moved key scan some camera sees.
std::vector<std::uint8_t> seen_by_any(const LidarScan& key_scan, const ScanMotion& motion,
                                      const std::vector<int>& owner) {
  const auto transforms = transforms_of(motion.T_lidar_t_lidar_k, motion.objects);
  std::vector<Eigen::Vector3f> points(key_scan.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = transforms[owner[i] + 1] * key_scan.points[i];
  std::vector<std::uint8_t> seen(points.size(), 0);
  for (const Camera& camera : motion.cameras) {
    const Pose T_camera_lidar = camera.T_vehicle_camera.inverse() * key_scan.T_vehicle_lidar;
    for (const ProjectedPoint& point : project_scan(camera.model, T_camera_lidar, points))
      seen[point.index] = 1;
  }
  return seen;
}

}  // namespace

VirtualScan assign_points(const LidarScan& key_scan, ScanMotion motion,
                          const std::string& output_label, const ComposeOptions& options) {
  const std::vector<int> owner = owners_of_points(key_scan.size(), motion.objects);
  std::vector<std::uint8_t> keep(key_scan.size(), 1);
  if (options.outside_view == OutsideView::drop) keep = seen_by_any(key_scan, motion, owner);
  if (options.objects == MovingObjects::drop)
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (owner[i] != kNobody && moves(motion.objects[owner[i]])) keep[i] = 0;

  for (const int i : motion.left_out) keep[i] = 0;

  VirtualScan result;
  result.source_index.reserve(keep.size());
  result.track_id.reserve(keep.size());
  for (int i = 0; i < static_cast<int>(keep.size()); ++i) {
    if (keep[i] == 0) continue;
    result.source_index.push_back(i);
    result.track_id.push_back(owner[i] == kNobody ? kNobody : motion.objects[owner[i]].track_id);
  }
  result.scan.stamp = motion.stamp;
  result.scan.label = output_label;
  result.scan.T_vehicle_lidar = key_scan.T_vehicle_lidar;
  result.key_stamp = key_scan.stamp;
  result.objects = std::move(motion.objects);
  result.T_lidar_t_lidar_k = motion.T_lidar_t_lidar_k;
  result.ego_extrapolated = motion.ego_extrapolated;
  return result;
}

void move_points(const LidarScan& key_scan, VirtualScan& scan) {
  const auto transforms = transforms_of(scan.T_lidar_t_lidar_k, scan.objects);
  std::map<int, int> of_track{{kNobody, 0}};
  for (std::size_t i = 0; i < scan.objects.size(); ++i)
    of_track[scan.objects[i].track_id] = static_cast<int>(i) + 1;
  scan.scan.points.resize(scan.source_index.size());
  auto motion = of_track.begin();
  for (std::size_t k = 0; k < scan.scan.points.size(); ++k) {
    if (motion->first != scan.track_id[k]) motion = of_track.find(scan.track_id[k]);
    scan.scan.points[k] = transforms[motion->second] * key_scan.points[scan.source_index[k]];
  }
  take_fields(key_scan, scan.source_index, scan.scan);
}

VirtualScan compose_virtual_scan(const LidarScan& key_scan, ScanMotion motion,
                                 const std::string& output_label, const ComposeOptions& options) {
  VirtualScan scan = assign_points(key_scan, std::move(motion), output_label, options);
  move_points(key_scan, scan);
  return scan;
}

}  // namespace lidar_upsampling
