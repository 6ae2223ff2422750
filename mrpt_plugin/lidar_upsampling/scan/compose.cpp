// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/compose.h"

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

void move_points(const LidarScan& key_scan, const ScanMotion& motion, const std::vector<int>& owner,
                 std::vector<Eigen::Vector3f>& moved) {
  std::vector<Eigen::Isometry3f> transforms{motion.T_lidar_t_lidar_k.cast<float>()};
  for (const ObjectMotion& object : motion.objects)
    transforms.push_back(object.T_lidar_t_lidar_k.cast<float>());
  moved.resize(key_scan.size());
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] = transforms[owner[i] + 1] * key_scan.points[i];
}

std::vector<std::uint8_t> seen_by_any(const std::vector<Camera>& cameras,
                                      const Pose& T_vehicle_lidar,
                                      const std::vector<Eigen::Vector3f>& points) {
  std::vector<std::uint8_t> seen(points.size(), 0);
  for (const Camera& camera : cameras) {
    const Pose T_camera_lidar = camera.T_vehicle_camera.inverse() * T_vehicle_lidar;
    for (const ProjectedPoint& point : project_scan(camera.model, T_camera_lidar, points))
      seen[point.index] = 1;
  }
  return seen;
}

}  // namespace

VirtualScan compose_virtual_scan(const LidarScan& key_scan, ScanMotion motion,
                                 const std::string& output_label, const ComposeOptions& options) {
  const std::vector<int> owner = owners_of_points(key_scan.size(), motion.objects);
  std::vector<Eigen::Vector3f> moved;
  move_points(key_scan, motion, owner, moved);

  std::vector<std::uint8_t> keep(moved.size(), 1);
  if (options.outside_view == OutsideView::drop)
    keep = seen_by_any(motion.cameras, key_scan.T_vehicle_lidar, moved);
  if (options.objects == MovingObjects::drop)
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (owner[i] != kNobody && moves(motion.objects[owner[i]])) keep[i] = 0;

  for (const int i : motion.left_out) keep[i] = 0;

  VirtualScan result;
  for (int i = 0; i < static_cast<int>(keep.size()); ++i)
    if (keep[i] != 0) result.source_index.push_back(i);
  for (const int i : result.source_index)
    result.track_id.push_back(owner[i] == kNobody ? kNobody : motion.objects[owner[i]].track_id);

  result.scan.stamp = motion.stamp;
  result.scan.label = output_label;
  result.scan.T_vehicle_lidar = key_scan.T_vehicle_lidar;
  result.scan.points = taken(moved, result.source_index);
  take_fields(key_scan, result.source_index, result.scan);
  result.key_stamp = key_scan.stamp;
  result.objects = std::move(motion.objects);
  result.T_lidar_t_lidar_k = motion.T_lidar_t_lidar_k;
  result.ego_extrapolated = motion.ego_extrapolated;
  return result;
}

}  // namespace lidar_upsampling
