// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/scene_segments.h"

#include <tbb/parallel_for.h>

#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/objects/level_slices.h"

namespace lidar_upsampling {
namespace {

std::vector<int> points_above_ground(const LidarScan& scan, const Ground& ground,
                                     const SegmentOptions& options) {
  const auto sq_range = static_cast<float>(options.max_range * options.max_range);
  const auto max_height = static_cast<float>(options.max_height);
  const bool has_ground = ground.status == GroundStatus::found;
  std::vector<int> indices;
  indices.reserve(scan.size() / 2);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (has_ground && (ground.is_ground[i] != 0 || ground.height[i] > max_height)) continue;
    if (scan.points[i].squaredNorm() < sq_range) indices.push_back(static_cast<int>(i));
  }
  return indices;
}

}  // namespace

SceneSegments segment_scan(const LidarScan& scan, const SegmentOptions& options) {
  SceneSegments segments;
  segments.vertical_step_deg = estimate_vertical_step_deg(scan);
  GroundOptions ground = options.ground;
  ground.vertical_step_deg = segments.vertical_step_deg;
  segments.ground = estimate_ground(scan, ground);
  ClusterOptions clustering = options.clusters;
  clustering.vertical_step_deg = segments.vertical_step_deg;
  segments.horizontal_step_deg = estimate_horizontal_step_deg(scan);
  if (segments.horizontal_step_deg) clustering.horizontal_step_deg = *segments.horizontal_step_deg;
  segments.clusters = euclidean_clusters(
      scan.points, points_above_ground(scan, segments.ground, options), clustering);
  segments.cluster_of.assign(scan.size(), -1);
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    for (const int index : segments.clusters[i]) segments.cluster_of[index] = static_cast<int>(i);
  }
  segments.extents.resize(segments.clusters.size());
  tbb::parallel_for(std::size_t{0}, segments.clusters.size(), [&](std::size_t i) {
    segments.extents[i] = cluster_extent(scan.points, segments.ground.height, segments.clusters[i]);
  });
  join_level_slices(scan, segments);
  return segments;
}

}  // namespace lidar_upsampling
