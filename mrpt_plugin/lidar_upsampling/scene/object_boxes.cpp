// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scene/object_boxes.h"

#include <cmath>
#include <numeric>

#include "lidar_upsampling/objects/cluster_extent.h"

namespace lidar_upsampling {
namespace {

constexpr double kMinSpeed_m_s = 1;  // slower, the velocity's direction is noise
constexpr std::size_t kMinPoints = 3;

using Points = std::vector<Eigen::Vector3f>;

// The virtual scan's points of each point of the key scan's.
std::vector<std::vector<int>> points_by_source(const VirtualScan& scan) {
  std::vector<std::vector<int>> by_source;
  for (std::size_t i = 0; i < scan.source_index.size(); ++i) {
    if (scan.source_index[i] < 0) continue;
    const auto source = static_cast<std::size_t>(scan.source_index[i]);
    if (source >= by_source.size()) by_source.resize(source + 1);
    by_source[source].push_back(static_cast<int>(i));
  }
  return by_source;
}

double yaw_of(const ObjectBox& box, const Points& points) {
  if (box.moving && box.velocity.head<2>().norm() > kMinSpeed_m_s)
    return std::atan2(box.velocity.y(), box.velocity.x());
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return cluster_extent(points, {}, all).yaw;
}

void fit(ObjectBox& box, const Points& points) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(yaw_of(box, points), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3f& point : points) extent.extend(R.transpose() * point.cast<double>());
  box.T_lidar_box.linear() = R;
  box.T_lidar_box.translation() = R * extent.center();
  box.size = extent.sizes();
}

}  // namespace

std::vector<ObjectBox> object_boxes(const VirtualScan& scan) {
  const auto by_source = points_by_source(scan);
  std::vector<ObjectBox> boxes;
  for (const ObjectMotion& object : scan.objects) {
    Points points;
    for (const int source : object.points)
      if (static_cast<std::size_t>(source) < by_source.size())
        for (const int i : by_source[source]) points.push_back(scan.scan.points[i]);
    if (points.size() < kMinPoints) continue;
    ObjectBox box;
    box.track_id = object.track_id;
    box.class_name = object.class_name;
    box.moving = moves(object);
    if (box.moving) box.velocity = scan.T_lidar_t_lidar_k.linear() * object.velocity_lidar_k;
    fit(box, points);
    boxes.push_back(std::move(box));
  }
  return boxes;
}

bool contains(const ObjectBox& box, const Eigen::Vector3d& point_lidar, double margin) {
  const Eigen::Vector3d in_box = box.T_lidar_box.inverse() * point_lidar;
  return (in_box.cwiseAbs().array() <= box.size.array() / 2 + margin).all();
}

}  // namespace lidar_upsampling
