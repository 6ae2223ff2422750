// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/anchored_scan.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {

Neighbourhood sampling_of(const LidarScan& scan, const CameraModel& camera) {
  Neighbourhood result;
  if (scan.num_rings < 2 || scan.ring.empty()) return result;
  double lowest = M_PI, highest = -M_PI;
  for (std::size_t i = 0; i < scan.size(); i += 16) {
    const Eigen::Vector3f& point = scan.points[i];
    const double elevation = std::atan2(point.z(), std::hypot(point.x(), point.y()));
    lowest = std::min(lowest, elevation);
    highest = std::max(highest, elevation);
  }
  const double ring_step_px = camera.fy * std::max(0., highest - lowest) / (scan.num_rings - 1);
  result.half_height_px = std::clamp(1.3 * ring_step_px, 3., 60.);
  if (const auto step = estimate_horizontal_step_deg(scan))
    result.half_width_px = std::clamp(2.6 * camera.fx * *step * kDegree, 3., 30.);
  return result;
}

AnchoredScan anchor_scan(const LidarScan& scan, const CameraModel& camera,
                         const Pose& T_camera_lidar_a) {
  AnchoredScan result;
  result.points = project_scan(camera, T_camera_lidar_a, scan.points);
  OcclusionOptions occlusion;
  DepthEdgeOptions edges;
  occlusion.neighbourhood = edges.neighbourhood = sampling_of(scan, camera);
  result.hidden = mark_occluded(result.points, occlusion);
  result.on_edge = mark_depth_edges(result.points, edges);
  result.position.assign(scan.size(), -1);
  for (std::size_t i = 0; i < result.points.size(); ++i)
    result.position[result.points[i].index] = static_cast<int>(i);
  return result;
}

std::vector<ProjectedPoint> visible_points(const AnchoredScan& anchored) {
  std::vector<ProjectedPoint> visible;
  for (std::size_t i = 0; i < anchored.points.size(); ++i)
    if (anchored.hidden[i] == 0) visible.push_back(anchored.points[i]);
  return visible;
}

std::vector<ProjectedPoint> followable_points(const AnchoredScan& anchored,
                                              const std::vector<int>& object, int min_points) {
  std::vector<ProjectedPoint> inner, all;
  for (const int i : object) {
    const int position = anchored.position[i];
    if (position < 0 || anchored.hidden[position] != 0) continue;
    all.push_back(anchored.points[position]);
    if (anchored.on_edge[position] == 0) inner.push_back(anchored.points[position]);
  }
  return static_cast<int>(inner.size()) >= min_points ? inner : all;
}

std::vector<ProjectedPoint> reprojected(const std::vector<ProjectedPoint>& points,
                                        const LidarScan& scan, const CameraModel& camera,
                                        const Pose& T_camera_a_lidar_k) {
  std::vector<ProjectedPoint> moved;
  for (ProjectedPoint point : points) {
    const Eigen::Vector3d p = T_camera_a_lidar_k * scan.points[point.index].cast<double>();
    const auto pixel = project(camera, p);
    if (!pixel) continue;
    point.u = static_cast<float>(pixel->x());
    point.v = static_cast<float>(pixel->y());
    moved.push_back(point);
  }
  return moved;
}

}  // namespace lidar_upsampling
