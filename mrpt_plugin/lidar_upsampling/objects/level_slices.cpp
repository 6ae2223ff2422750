// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/level_slices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lidar_upsampling/azimuth.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Whether one ring shows all of a cluster, where rings are so close that they show more of
/// whatever is upright.
/// @param vertical_step_deg between neighbouring rings.
bool is_level_slice(const LidarScan& scan, const std::vector<int>& cluster,
                    double vertical_step_deg) {
  constexpr float kUpright_m = 0.25F, kOneRing = 0.5F;  // of the step between rings
  const auto step = static_cast<float>(std::tan(vertical_step_deg * kDegree));
  float least = std::numeric_limits<float>::infinity(), most = -least;
  for (const int i : cluster) {
    const float range = scan.points[i].head<2>().norm(), slope = scan.points[i].z() / range;
    least = std::min(least, slope);
    most = std::max(most, slope);
    if (most - least > kOneRing * step || range * step > kUpright_m) return false;
  }
  return true;
}

/// Directions as the sensor sees them.
struct Directions {
  Eigen::Vector2f ahead;      ///< unit, level
  float left = 0, right = 0;  ///< tangents of the azimuth about `ahead`
  float slope = 0;            ///< tangent of the elevation
  float range = 0;            ///< m, level
};

Directions directions_of(const LidarScan& scan, const std::vector<int>& cluster,
                         const ClusterExtent& extent) {
  Directions result;
  result.range = extent.centroid.head<2>().norm();
  result.ahead = extent.centroid.head<2>() / result.range;
  result.slope = extent.centroid.z() / result.range;
  for (const int i : cluster) {
    const float aside = tangent_from(result.ahead, scan.points[i]);
    result.left = std::max(result.left, aside);
    result.right = std::min(result.right, aside);
  }
  return result;
}

/// How many points of a cluster lie below and before a slice.
std::size_t num_before(const LidarScan& scan, const std::vector<int>& cluster,
                       const Directions& slice) {
  constexpr float kRoof_m = 4;  // from a car's end to the far end of its roof
  return std::count_if(cluster.begin(), cluster.end(), [&](int i) {
    const Eigen::Vector3f& point = scan.points[i];
    const float range = point.head<2>().norm(), aside = tangent_from(slice.ahead, point);
    return slice.ahead.dot(point.head<2>()) > 0 && aside <= slice.left && aside >= slice.right &&
           range < slice.range && range > slice.range - kRoof_m && point.z() < slice.slope * range;
  });
}

/// @return -1: none.
int whole_of(const LidarScan& scan, const SceneSegments& segments, std::size_t slice,
             const std::vector<bool>& is_slice) {
  const ClusterExtent& extent = segments.extents[slice];
  const Directions directions = directions_of(scan, segments.clusters[slice], extent);
  int whole = -1;
  std::size_t most = segments.clusters[slice].size() - 1;  // in each column one at least
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    const ClusterExtent& other = segments.extents[i];
    const float reach = kLongestVehicle_m + other.length;
    if (is_slice[i] || (other.centroid - extent.centroid).squaredNorm() > reach * reach) continue;
    const std::size_t here = num_before(scan, segments.clusters[i], directions);
    if (here <= most) continue;
    most = here;
    whole = static_cast<int>(i);
  }
  return whole;
}

}  // namespace

void join_level_slices(const LidarScan& scan, SceneSegments& segments) {
  if (segments.ground.status != GroundStatus::found) return;
  auto& clusters = segments.clusters;
  std::vector<bool> is_slice;
  is_slice.reserve(clusters.size());
  for (const auto& cluster : clusters)
    is_slice.push_back(is_level_slice(scan, cluster, segments.vertical_step_deg));
  std::vector<int> whole(clusters.size(), -1);
  for (std::size_t i = 0; i < clusters.size(); ++i)
    if (is_slice[i]) whole[i] = whole_of(scan, segments, i, is_slice);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (whole[i] < 0) continue;
    auto& points = clusters[whole[i]];
    points.insert(points.end(), clusters[i].begin(), clusters[i].end());
    std::sort(points.begin(), points.end());
    segments.extents[whole[i]] = cluster_extent(scan.points, segments.ground.height, points);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (whole[i] >= 0) continue;
    for (const int point : clusters[i]) segments.cluster_of[point] = static_cast<int>(kept);
    if (kept != i) clusters[kept] = std::move(clusters[i]);
    segments.extents[kept++] = segments.extents[i];
  }
  clusters.resize(kept);
  segments.extents.resize(kept);
}

}  // namespace lidar_upsampling
