// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
  double depth = 0;        ///< m, mean
  int scene_cluster = -1;  ///< that holds most of its points
  int scene_hits = 0;
  double share = 1;  ///< of what the picture shows of that cluster, how much lies in the box
};

/// How many points of each cluster of the scene the picture shows.
std::vector<int> count_visible(const std::vector<ProjectedPoint>& visible,
                               const SceneSegments& segments) {
  std::vector<int> count(segments.clusters.size(), 0);
  for (const ProjectedPoint& point : visible) {
    const int cluster = segments.cluster_of[point.index];
    if (cluster >= 0) ++count[cluster];
  }
  return count;
}

/// Finds the scene's cluster of a candidate, unless it is a wall, a hedge or the like.
void find_in_scene(Candidate& candidate, const SceneSegments& segments,
                   const std::vector<int>& num_visible, const ClusterOptions& options) {
  std::map<int, int> hits;
  for (const int index : candidate.points) ++hits[segments.cluster_of[index]];
  const auto [cluster, most] = *std::max_element(
      hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (cluster < 0 || segments.extents[cluster].length > options.max_length ||
      segments.extents[cluster].width > options.max_width)
    return;
  candidate.scene_cluster = cluster;
  candidate.scene_hits = most;
  candidate.share = static_cast<double>(most) / num_visible[cluster];
}

/// `seen` is in the order of the scan, as are the points of a cluster.
Candidate make_candidate(std::vector<int> cluster, const std::vector<ProjectedPoint>& seen) {
  Candidate candidate;
  candidate.box = Box2d::around_nothing();
  auto at = seen.begin();
  for (const int index : cluster) {
    while (at->index != index) ++at;
    candidate.box.extend(at->u, at->v);
    candidate.depth += at->depth;
  }
  candidate.depth /= static_cast<double>(cluster.size());
  candidate.points = std::move(cluster);
  return candidate;
}

/// Each term in [0, 1]. Points are counted as area, or a near scrap of a bush would outweigh a far
/// car; what goes on outside the box is something nearer that hides a part of the object.
double rate(const Candidate& candidate, const Box2d& box, double most_area, double nearest) {
  const double area =
      static_cast<double>(candidate.points.size()) * candidate.depth * candidate.depth;
  const double off_centre =
      std::abs(candidate.box.left + candidate.box.right - box.left - box.right);
  const double centred = 1 - std::min(1., off_centre / box.width());
  return intersection_over_union(candidate.box, box) + 0.5 * std::sqrt(area / most_area) +
         candidate.share + 0.3 * centred + 0.3 * nearest / candidate.depth;
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

/// The scene's cluster, where it is about what the box shows, whatever lies outside the picture.
const std::vector<int>* whole_cluster_of(const Candidate& candidate, const SceneSegments& segments,
                                         double min_share) {
  const auto needed = min_share * static_cast<double>(candidate.points.size());
  if (candidate.scene_cluster < 0 || candidate.share < min_share) return nullptr;
  return candidate.scene_hits < needed ? nullptr : &segments.clusters[candidate.scene_cluster];
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
  const std::vector<int> num_visible = count_visible(visible, segments);
  std::vector<Candidate> candidates;
  double most_area = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (auto& cluster : euclidean_clusters(scan.points, indices, clustering)) {
    Candidate candidate = make_candidate(std::move(cluster), seen);
    if (intersection_over_union(candidate.box, box) < options.min_overlap) continue;
    find_in_scene(candidate, segments, num_visible, clustering);
    const auto size = static_cast<double>(candidate.points.size());
    most_area = std::max(most_area, size * candidate.depth * candidate.depth);
    nearest = std::min(nearest, candidate.depth);
    candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) return std::nullopt;

  const auto best = std::max_element(
      candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        return rate(a, box, most_area, nearest) < rate(b, box, most_area, nearest);
      });
  const auto* whole = whole_cluster_of(*best, segments, options.min_share);
  return whole != nullptr ? *whole : best->points;
}

}  // namespace lidar_upsampling
