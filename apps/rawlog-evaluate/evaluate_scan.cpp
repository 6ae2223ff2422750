// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <algorithm>

#include "clouds.h"
#include "estimates.h"
#include "evaluation.h"
#include "instant_reference.h"

namespace lidar_upsampling {

namespace {

/// T_camera_lidar of the first camera that sees the point, of the first one if none does.
std::optional<Pose> viewing_camera(const std::vector<View>& views,
                                   const Eigen::Vector3d& point_in_lidar) {
  if (views.empty()) return {};
  const auto viewing = std::find_if(
      views.begin(), views.end(), [&](const View& view) { return in_view(view, point_in_lidar); });
  return (viewing != views.end() ? *viewing : views.front()).T_camera_lidar;
}

ObjectError error_of(const ReferenceMotion& object, const Pose& estimate,
                     const std::optional<Pose>& T_camera_lidar, double dt) {
  ObjectError error;
  error.position_m = position_error(object, estimate);
  error.velocity_mps = velocity_error(object, estimate, dt);
  error.yaw_rad = yaw_error(object, estimate);
  if (T_camera_lidar) error.depth_share = depth_error(object, estimate, *T_camera_lidar);
  return error;
}

std::vector<ObjectResult> evaluate_objects(std::vector<ObjectReference> references,
                                           const RowSources& sources,
                                           const std::vector<Camera>& cameras, double dt) {
  const std::vector<View> views = views_of(cameras, sources.scans.reference);
  std::vector<ObjectResult> results(references.size());
  tbb::parallel_for(std::size_t{0}, references.size(), [&](std::size_t i) {
    ObjectResult& result = results[i];
    result.object = std::move(references[i]);
    result.num_points = result.object.points.size();
    if (!result.object.excluded.empty()) return;
    result.estimates = estimates_of(result.object, sources);
    const ReferenceMotion& motion = result.object.motion;
    const auto T_camera_lidar = viewing_camera(views, motion.T_lidar_t_lidar_k * motion.centroid_k);
    for (const Row row : kRows)
      if (row != Row::oracle && result.estimates[row])
        result.errors[row] = error_of(motion, *result.estimates[row], T_camera_lidar, dt);
  });
  return results;
}

/// A point of the key scan where a row puts it; none if the row does not tell.
std::optional<Eigen::Vector3d> moved_point(Row row, int i, const RowSources& sources,
                                           const ObjectResult* object) {
  const auto matched = [&](const MovedScan& moved) -> std::optional<Eigen::Vector3d> {
    if (moved.matches.empty() || moved.matches[i] < 0) return {};
    return moved.scan->points[moved.matches[i]].cast<double>();
  };
  if (row == Row::ours) return matched(sources.ours);
  if (row == Row::paper && sources.paper) return matched(*sources.paper);
  const Eigen::Vector3d key = sources.scans.key.points[i].cast<double>();
  if (row == Row::hold) return key;
  if (row == Row::ego) return sources.T_ego * key;
  if (row != Row::constant_velocity) return {};
  return (object && object->estimates[row] ? *object->estimates[row] : sources.T_ego) * key;
}

/// Every point of a moving object counts, so that one in many pieces weighs no more than one in
/// one.
void measure_moving_points(const RowSources& sources, ScanResult& result) {
  for (const Row row : kRows) {
    double sum = 0;
    int count = 0;
    for (const ObjectResult& object : result.objects) {
      if (!object.object.moving || !object.object.excluded.empty()) continue;
      for (const int i : object.object.points) {
        const auto moved = moved_point(row, i, sources, &object);
        if (!moved) continue;
        const Eigen::Vector3d key = sources.scans.key.points[i].cast<double>();
        sum += (*moved - object.object.motion.T_lidar_t_lidar_k * key).norm();
        ++count;
      }
    }
    if (count > 0) result.moving_points_m[row] = sum / count;
  }
}

/// Flow of every point within range, and how far the static scene goes astray: with true boxes
/// only.
/// @param left_out points of objects that are not judged.
void measure_flow(const RowSources& sources, double max_range, const std::vector<int>& left_out,
                  ScanResult& result) {
  const LidarScan& key = sources.scans.key;
  std::vector<bool> counts(key.size(), true);
  for (const int i : left_out) counts[i] = false;
  std::vector<const ObjectResult*> owner(key.size(), nullptr);
  for (const ObjectResult& object : result.objects)
    for (const int i : object.object.points) owner[i] = &object;
  for (const Row row : kRows) {
    std::vector<PointFlow> flows;
    double sum_static = 0;
    int num_static = 0;
    for (int i = 0; i < static_cast<int>(key.size()); ++i) {
      const Eigen::Vector3d point = key.points[i].cast<double>();
      if (!counts[i] || point.head<2>().norm() > max_range) continue;
      const auto moved = moved_point(row, i, sources, owner[i]);
      if (!moved) continue;
      PointFlow flow;
      flow.estimated = *moved - point;
      flow.truth =
          (owner[i] ? owner[i]->object.motion.T_lidar_t_lidar_k : sources.T_ego) * point - point;
      if (owner[i])
        flow.kind =
            owner[i]->object.moving ? FlowClass::foreground_dynamic : FlowClass::foreground_static;
      flows.push_back(flow);
      if (flow.kind == FlowClass::foreground_dynamic) continue;
      sum_static += (flow.estimated - flow.truth).norm();
      ++num_static;
    }
    if (flows.empty()) continue;
    result.flow[row] = three_way_epe(flows);
    if (num_static > 0) result.static_error_m[row] = sum_static / num_static;
  }
}

}  // namespace

ScanResult evaluate_scan(const ScanSet& scans, InstantReference reference,
                         const std::vector<Camera>& cameras, const EvaluationOptions& options) {
  ScanResult result;
  result.stamp = scans.virtual_scan.stamp;
  result.key_stamp = scans.key.stamp;
  result.dt = seconds_between(scans.key.stamp, scans.virtual_scan.stamp);
  result.interpolated = reference.interpolated;

  const RowSources sources = prepare_rows(scans, reference.T_ego);
  result.points_told = !sources.ours.matches.empty();
  result.objects = evaluate_objects(std::move(reference.objects), sources, cameras, result.dt);
  measure_moving_points(sources, result);
  if (reference.by_truth)
    measure_flow(sources, options.max_range_m, reference.other_points, result);
  const PerRow<Points> clouds = whole_clouds(sources, result.objects);
  if (options.chamfer) measure_clouds(clouds, scans.reference, cameras, result);
  measure_samples(clouds, scans, cameras, options, result);
  return result;
}

}  // namespace lidar_upsampling
