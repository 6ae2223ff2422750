// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <numeric>

#include "evaluation.h"
#include "lidar_upsampling/metrics/scan_motion.h"
#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/registration/scan_registration.h"

namespace lidar_upsampling {

namespace {

using Points = std::vector<Eigen::Vector3f>;

/// The virtual scan as recover_motion() wants it; its surface is only made if beams do not tell the
/// points.
struct VirtualPoints {
  std::vector<int> matches;
  Surface surface;
};

VirtualPoints prepare(const ScanTriple& scans) {
  std::vector<int> matches = match_by_beam(scans.key, scans.virtual_scan);
  Points standing;
  if (matches.empty()) {
    const Ground ground = estimate_ground(scans.virtual_scan);
    for (std::size_t i = 0; i < scans.virtual_scan.size(); ++i)
      if (ground.is_ground.empty() || ground.is_ground[i] == 0)
        standing.push_back(scans.virtual_scan.points[i]);
  }
  return {std::move(matches), make_surface(std::move(standing))};
}

/// One object's motion according to each row.
std::array<std::optional<Pose>, kRows.size()> estimates_of(const ObjectReference& object,
                                                           const ScanTriple& scans,
                                                           const VirtualPoints& points,
                                                           const Pose& T_ego) {
  const auto ours =
      recover_motion(scans.key, scans.virtual_scan, object.points, points.matches, points.surface,
                     {T_ego, Pose::Identity(), object.motion.T_lidar_t_lidar_k});
  return {ours, Pose::Identity(), T_ego};
}

std::vector<ObjectResult> evaluate_objects(std::vector<ObjectReference> references,
                                           const ScanTriple& scans, const VirtualPoints& points,
                                           const Pose& T_ego) {
  std::vector<ObjectResult> results(references.size());
  tbb::parallel_for(std::size_t{0}, references.size(), [&](std::size_t i) {
    results[i].object = std::move(references[i]);
    if (!results[i].object.excluded.empty()) return;
    const auto estimates = estimates_of(results[i].object, scans, points, T_ego);
    for (std::size_t row = 0; row < kRows.size(); ++row)
      if (estimates[row])
        results[i].error_m[row] = position_error(results[i].object.motion, *estimates[row]);
  });
  return results;
}

Points moved(const Points& points, const Pose& T) {
  Points result;
  result.reserve(points.size());
  for (const auto& point : points) result.emplace_back((T * point.cast<double>()).cast<float>());
  return result;
}

Points seen_only(const Points& points, const LidarScan& scan, const std::vector<Camera>& cameras) {
  Points result;
  for (const auto& point : points)
    if (in_view(cameras, scan, point.cast<double>())) result.push_back(point);
  return result;
}

std::array<Points, kRows.size()> clouds_of(const ScanTriple& scans, const Pose& T_ego) {
  return {scans.virtual_scan.points, scans.key.points, moved(scans.key.points, T_ego)};
}

void evaluate_clouds(const ScanTriple& scans, const Pose& T_ego, const std::vector<Camera>& cameras,
                     ScanResult& result) {
  const Points seen = seen_only(scans.reference.points, scans.reference, cameras);
  const auto clouds = clouds_of(scans, T_ego);
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    if (clouds[row].empty() || scans.reference.points.empty()) continue;
    CloudResult cloud{compute_chamfer(clouds[row], scans.reference.points), std::nullopt};
    const Points own_seen = seen_only(clouds[row], scans.key, cameras);
    if (!seen.empty() && !own_seen.empty()) cloud.in_view = compute_chamfer(own_seen, seen);
    result.clouds[row] = cloud;
  }
}

/// Every point of a moving object counts, so that one in many pieces weighs no more than one in
/// one.
void evaluate_moving_points(const ScanTriple& scans, const std::vector<int>& matches,
                            const Pose& T_ego, ScanResult& result) {
  std::array<double, kRows.size()> sum{};
  int count = 0;
  for (const ObjectResult& object : result.objects) {
    if (!object.object.moving || !object.object.excluded.empty() || matches.empty()) continue;
    for (const int i : object.object.points) {
      if (matches[i] < 0) continue;
      const Eigen::Vector3d key = scans.key.points[i].cast<double>();
      const Eigen::Vector3d truth = object.object.motion.T_lidar_t_lidar_k * key;
      sum[0] += (scans.virtual_scan.points[matches[i]].cast<double>() - truth).norm();
      sum[1] += (key - truth).norm();
      sum[2] += (T_ego * key - truth).norm();
      ++count;
    }
  }
  for (std::size_t row = 0; row < kRows.size() && count > 0; ++row)
    result.moving_points_m[row] = sum[row] / count;
}

/// Mean distance from where the true ego-motion takes the points of all that stands.
void evaluate_static(const ScanTriple& scans, const std::vector<int>& matches, const Pose& T_ego,
                     double max_range, ScanResult& result) {
  std::vector<std::uint8_t> moves(scans.key.size(), 0);
  for (const ObjectResult& object : result.objects)
    if (object.object.moving)
      for (const int i : object.object.points) moves[i] = 1;
  std::array<double, kRows.size()> sum{};
  int count = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Eigen::Vector3d key = scans.key.points[i].cast<double>();
    if (matches[i] < 0 || moves[i] != 0 || key.head<2>().norm() > max_range) continue;
    const Eigen::Vector3d truth = T_ego * key;
    sum[0] += (scans.virtual_scan.points[matches[i]].cast<double>() - truth).norm();
    sum[1] += (key - truth).norm();
    ++count;
  }
  if (count == 0) return;
  for (std::size_t row = 0; row < kRows.size(); ++row)
    result.static_error_m[row] = sum[row] / count;
}

std::optional<Pose> reference_ego_motion(const ScanTriple& scans, const Truth* truth,
                                         const Pose& guess) {
  if (truth) return true_ego_motion(*truth, scans.key, scans.virtual_scan.stamp);
  const auto found = register_scans(scans.key.points, scans.reference.points, guess);
  return found ? std::make_optional(found->T_target_source) : std::nullopt;
}

}  // namespace

ScanResult evaluate_scan(const ScanTriple& scans, const Truth* truth,
                         const std::vector<Camera>& cameras, const Pose& T_ego_guess,
                         const EvaluationOptions& options, Pose* T_ego_found) {
  ScanResult result;
  result.stamp = scans.virtual_scan.stamp;
  result.key_stamp = scans.key.stamp;
  result.dt = seconds_between(scans.key.stamp, scans.virtual_scan.stamp);
  const auto T_ego = reference_ego_motion(scans, truth, T_ego_guess);
  result.ego_found = T_ego.has_value();
  if (!T_ego) return result;
  *T_ego_found = *T_ego;

  const VirtualPoints points = prepare(scans);
  result.by_beam = !points.matches.empty();
  result.objects = evaluate_objects(find_references(scans, truth, *T_ego, cameras, options), scans,
                                    points, *T_ego);
  evaluate_moving_points(scans, points.matches, *T_ego, result);
  evaluate_clouds(scans, *T_ego, cameras, result);
  if (truth) evaluate_static(scans, points.matches, *T_ego, options.max_range_m, result);
  return result;
}

}  // namespace lidar_upsampling
