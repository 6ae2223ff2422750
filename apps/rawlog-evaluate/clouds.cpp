// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "clouds.h"

#include "lidar_upsampling/metrics/chamfer.h"

namespace lidar_upsampling {

namespace {

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

/// By the ego-motion, objects by the row's own estimate.
Points moved_with_objects(const RowSources& sources, const std::vector<ObjectResult>& objects,
                          Row row) {
  const Points& key = sources.scans.key.points;
  Points cloud = moved(key, sources.T_ego);
  for (const ObjectResult& object : objects) {
    if (!object.object.excluded.empty() || !object.estimates[row]) continue;
    for (const int i : object.object.points)
      cloud[i] = (*object.estimates[row] * key[i].cast<double>()).cast<float>();
  }
  return cloud;
}

}  // namespace

PerRow<Points> whole_clouds(const RowSources& sources, const std::vector<ObjectResult>& objects) {
  const ScanSet& scans = sources.scans;
  PerRow<Points> clouds;
  clouds[Row::floor] = scans.reference.points;
  clouds[Row::hold] = scans.key.points;
  clouds[Row::ego] = moved(scans.key.points, sources.T_ego);
  clouds[Row::constant_velocity] = moved_with_objects(sources, objects, Row::constant_velocity);
  if (sources.paper) clouds[Row::paper] = sources.paper->scan->points;
  clouds[Row::ours] = scans.virtual_scan.points;
  clouds[Row::oracle] = moved_with_objects(sources, objects, Row::oracle);
  return clouds;
}

void measure_clouds(const PerRow<Points>& clouds, const LidarScan& reference,
                    const std::vector<Camera>& cameras, ScanResult& result) {
  const Points seen = seen_only(reference.points, reference, cameras);
  for (const Row row : kRows) {
    // Nothing is sampled here: the floor is zero.
    if (row == Row::floor || clouds[row].empty() || reference.points.empty()) continue;
    CloudResult cloud{compute_chamfer(clouds[row], reference.points), std::nullopt};
    const Points own_seen = seen_only(clouds[row], reference, cameras);
    if (!seen.empty() && !own_seen.empty()) cloud.in_view = compute_chamfer(own_seen, seen);
    result.clouds[row] = cloud;
  }
}

}  // namespace lidar_upsampling
