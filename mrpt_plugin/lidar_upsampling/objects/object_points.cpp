// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lidar_upsampling/objects/tracks.h"

namespace lidar_upsampling {
namespace {

Box2d grown(const Box2d& box, double margin) {
  const double du = margin * box.width();
  const double dv = margin * box.height();
  return {box.left - du, box.top - dv, box.right + du, box.bottom + dv};
}

/// A cluster of the frustum on the picture.
struct Candidate {
  std::vector<int> points;
  Box2d box;
  double depth = 0;  ///< m, mean
};

/// `seen` is in the order of the scan, as are the points of a cluster.
Candidate make_candidate(std::vector<int> cluster, const std::vector<ProjectedPoint>& seen) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Candidate candidate;
  candidate.box = {kFar, kFar, -kFar, -kFar};
  auto at = seen.begin();
  for (const int index : cluster) {
    while (at->index != index) ++at;
    candidate.box = {std::min(candidate.box.left, static_cast<double>(at->u)),
                     std::min(candidate.box.top, static_cast<double>(at->v)),
                     std::max(candidate.box.right, static_cast<double>(at->u)),
                     std::max(candidate.box.bottom, static_cast<double>(at->v))};
    candidate.depth += at->depth;
  }
  candidate.depth /= static_cast<double>(cluster.size());
  candidate.points = std::move(cluster);
  return candidate;
}

/// Each term in [0, 1]. Points are counted as area, or a near scrap of a bush would outweigh a far
/// car.
double rate(const Candidate& candidate, const Box2d& box, double most_area, double nearest) {
  const double area =
      static_cast<double>(candidate.points.size()) * candidate.depth * candidate.depth;
  const double off_centre =
      std::abs(candidate.box.left + candidate.box.right - box.left - box.right);
  const double centred = 1 - std::min(1., off_centre / box.width());
  return intersection_over_union(candidate.box, box) + 0.5 * std::sqrt(area / most_area) +
         0.3 * centred + 0.3 * nearest / candidate.depth;
}

std::vector<int> frustum_points(const std::vector<ProjectedPoint>& visible, const Ground& ground,
                                const Box2d& box, std::vector<ProjectedPoint>& seen) {
  std::vector<int> indices;
  for (const ProjectedPoint& point : visible) {
    if (!box.contains(point.u, point.v)) continue;
    if (ground.status == GroundStatus::found && ground.is_ground[point.index] != 0) continue;
    indices.push_back(point.index);
    seen.push_back(point);
  }
  return indices;
}

/// The scene's cluster that holds most of the points, if it is no larger than an object of which
/// they are the greater part.
const std::vector<int>* whole_cluster_of(const std::vector<int>& points,
                                         const SceneSegments& segments,
                                         const ObjectPointOptions& options) {
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    const std::vector<int>& cluster = segments.clusters[i];
    if (2 * cluster.size() < points.size()) break;  // the largest come first
    const ClusterExtent& extent = segments.extents[i];
    if (extent.length > options.max_length || extent.width > options.max_width) continue;
    if (static_cast<double>(cluster.size()) >
        options.max_growth * static_cast<double>(points.size())) {
      continue;
    }
    const auto common = std::count_if(points.begin(), points.end(), [&](int index) {
      return std::binary_search(cluster.begin(), cluster.end(), index);
    });
    if (2 * common > static_cast<std::ptrdiff_t>(points.size())) return &cluster;
  }
  return nullptr;
}

}  // namespace

std::optional<std::vector<int>> select_object_points(const LidarScan& scan,
                                                     const std::vector<ProjectedPoint>& visible,
                                                     const SceneSegments& segments,
                                                     const Box2d& box,
                                                     const ObjectPointOptions& options) {
  std::vector<ProjectedPoint> seen;
  const std::vector<int> indices =
      frustum_points(visible, segments.ground, grown(box, options.box_margin), seen);
  ClusterOptions clustering = options.clusters;
  clustering.min_points = options.min_points;
  clustering.vertical_step_deg = segments.vertical_step_deg;
  std::vector<Candidate> candidates;
  double most_area = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (auto& cluster : euclidean_clusters(scan.points, indices, clustering)) {
    Candidate candidate = make_candidate(std::move(cluster), seen);
    if (intersection_over_union(candidate.box, box) < options.min_overlap) continue;
    const double size = static_cast<double>(candidate.points.size());
    most_area = std::max(most_area, size * candidate.depth * candidate.depth);
    nearest = std::min(nearest, candidate.depth);
    candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) return std::nullopt;

  const auto best = std::max_element(
      candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        return rate(a, box, most_area, nearest) < rate(b, box, most_area, nearest);
      });
  if (options.whole_cluster) {
    if (const auto* whole = whole_cluster_of(best->points, segments, options)) return *whole;
  }
  return best->points;
}

}  // namespace lidar_upsampling
