// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "estimates.h"

#include "lidar_upsampling/metrics/scan_motion.h"
#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {

namespace {

Pose constant_velocity(const ObjectReference& object, const RowSources& sources) {
  if (!object.last_motion) return sources.T_ego;
  const double dt = seconds_between(sources.scans.key.stamp, sources.scans.virtual_scan.stamp);
  return sources.T_ego * exp_se3(Twist(dt * object.last_motion->per_second));
}

std::optional<Pose> recovered(const ObjectReference& object, const RowSources& sources,
                              const MovedScan& moved) {
  return recover_motion(sources.scans.key, *moved.scan, object.points, moved.matches, moved.surface,
                        {sources.T_ego, Pose::Identity(), object.motion.T_lidar_t_lidar_k});
}

}  // namespace

MovedScan prepare_moved_scan(const LidarScan& key, const LidarScan& virtual_scan) {
  std::vector<int> matches = match_by_beam(key, virtual_scan);
  if (matches.empty()) matches = match_in_order(key, virtual_scan);
  Surface surface =
      Surface(matches.empty() ? without_ground(virtual_scan) : std::vector<Eigen::Vector3f>{});
  return {&virtual_scan, std::move(matches), std::move(surface)};
}

RowSources prepare_rows(const ScanSet& scans, const Pose& T_ego) {
  RowSources sources{scans, T_ego, prepare_moved_scan(scans.key, scans.virtual_scan), std::nullopt};
  if (scans.paper) sources.paper = prepare_moved_scan(scans.key, *scans.paper);
  return sources;
}

Estimates estimates_of(const ObjectReference& object, const RowSources& sources) {
  Estimates estimates;
  estimates[Row::hold] = Pose::Identity();
  estimates[Row::ego] = sources.T_ego;
  estimates[Row::constant_velocity] = constant_velocity(object, sources);
  estimates[Row::ours] = recovered(object, sources, sources.ours);
  if (sources.paper) estimates[Row::paper] = recovered(object, sources, *sources.paper);
  estimates[Row::oracle] = object.motion.T_lidar_t_lidar_k;
  return estimates;
}

}  // namespace lidar_upsampling
