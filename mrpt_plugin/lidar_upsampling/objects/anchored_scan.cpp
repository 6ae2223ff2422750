// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/anchored_scan.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr float kPatchReach_px = 8;

// What a patch shows of its object, and of others: on which side.
class PatchContent {
 public:
  void add(const ProjectedPoint& centre, const ProjectedPoint& point, bool is_own) {
    const cv::Point2f d(point.u - centre.u, point.v - centre.v);
    if (std::abs(d.x) >= kPatchReach_px || std::abs(d.y) >= kPatchReach_px) return;
    const float weight =
        (1 - std::abs(d.x) / kPatchReach_px) * (1 - std::abs(d.y) / kPatchReach_px);
    all_ += weight;
    if (!is_own) others_ += weight * d;
  }

  // In the middle between two sides there is nowhere to go; too far, and the object ends.
  [[nodiscard]] cv::Point2f shift() const {
    constexpr float kGain = 1.5, kFarthest_px = 4;
    const cv::Point2f away = all_ > 0 ? others_ * (-kGain / all_) : cv::Point2f();
    const float length = std::hypot(away.x, away.y);
    return length > kFarthest_px ? away * (kFarthest_px / length) : away;
  }

 private:
  float all_ = 0;
  cv::Point2f others_;
};

// Points that the object's patches may show beside it.
std::vector<ProjectedPoint> others_around(const AnchoredScan& anchored,
                                          const std::vector<int>& object) {
  std::vector<std::uint8_t> is_own(anchored.points.size(), 0);
  Box2d reach = Box2d::around_nothing();
  for (const int i : object) {
    if (anchored.position[i] < 0) continue;
    is_own[anchored.position[i]] = 1;
    const ProjectedPoint& point = anchored.points[anchored.position[i]];
    reach.extend(point.u - kPatchReach_px, point.v - kPatchReach_px);
    reach.extend(point.u + kPatchReach_px, point.v + kPatchReach_px);
  }
  std::vector<ProjectedPoint> others;
  for (std::size_t i = 0; i < is_own.size(); ++i)
    if (is_own[i] == 0 && reach.contains(anchored.points[i].u, anchored.points[i].v))
      others.push_back(anchored.points[i]);
  return others;
}

}  // namespace

Neighbourhood sampling_of(const LidarScan& scan, const CameraModel& camera) {
  constexpr double kFinest_px = 5;
  Neighbourhood result{kFinest_px, 7};
  if (scan.num_rings < 2 || scan.ring.empty()) return result;
  double lowest = M_PI, highest = -M_PI;
  for (std::size_t i = 0; i < scan.size(); i += 16) {
    const Eigen::Vector3f& point = scan.points[i];
    const double elevation = std::atan2(point.z(), std::hypot(point.x(), point.y()));
    lowest = std::min(lowest, elevation);
    highest = std::max(highest, elevation);
  }
  const double ring_step_px = camera.fy * std::max(0., highest - lowest) / (scan.num_rings - 1);
  result.half_height_px = std::clamp(1.3 * ring_step_px, kFinest_px, 60.);
  if (const auto step = estimate_horizontal_step_deg(scan))
    result.half_width_px = std::clamp(2.6 * camera.fx * *step * kDegree, kFinest_px, 30.);
  return result;
}

AnchoredScan anchor_scan(const LidarScan& scan, const CameraModel& camera,
                         const Pose& T_camera_lidar_a) {
  AnchoredScan result;
  result.points = project_scan(camera, T_camera_lidar_a, scan.points);
  OcclusionOptions occlusion;
  DepthEdgeOptions edges;
  result.sampling = occlusion.neighbourhood = edges.neighbourhood = sampling_of(scan, camera);
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

std::vector<cv::Point2f> inward_shifts(const AnchoredScan& anchored, const std::vector<int>& object,
                                       const std::vector<ProjectedPoint>& points) {
  const std::vector<ProjectedPoint> others = others_around(anchored, object);
  std::vector<cv::Point2f> shifts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int position = anchored.position[points[i].index];
    if (anchored.on_edge[position] == 0) continue;
    PatchContent content;
    for (const int own : object)
      if (const int at = anchored.position[own]; at >= 0)
        content.add(anchored.points[position], anchored.points[at], true);
    for (const ProjectedPoint& other : others) content.add(anchored.points[position], other, false);
    shifts[i] = content.shift();
  }
  return shifts;
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
