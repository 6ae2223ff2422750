// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/road_users.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/hidden_foot.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

bool within(double value, double low, double high) { return value >= low && value <= high; }

/// But for where it begins above the ground. What one ring shows reaches up to the next, `ring_m`.
/// One that the sensor's view cuts off may be longer than it seems, `is_cut_off`.
bool has_size_of_road_user(const ClusterExtent& extent, std::size_t num_points, bool has_ground,
                           double ring_m, bool is_cut_off, const ClusterDetectorOptions& options) {
  if (static_cast<int>(num_points) < options.min_points) return false;
  if (!within(extent.centroid.head<2>().norm(), options.min_range, options.max_range)) return false;
  if (!within(extent.length, is_cut_off ? 0 : options.min_length, options.max_length)) return false;
  if (extent.width > options.max_width) return false;
  if (!has_ground) return within(extent.height(), options.min_height / 2, options.max_height);
  const double top = extent.height() < ring_m / 2 ? extent.top + ring_m : extent.top;
  return top >= options.min_height && extent.top <= options.max_height;
}

/// Tells clusters at the sides of a view that does not go all around.
class ViewEdge {
 public:
  ViewEdge(const LidarScan& scan, const std::optional<double>& horizontal_step_deg) : scan_(scan) {
    constexpr double kAround_deg = 350;
    has_sides_ = horizontal_step_deg && *horizontal_step_deg * scan.num_columns < kAround_deg;
  }

  [[nodiscard]] bool cuts_off(const std::vector<int>& cluster) const {
    return has_sides_ && std::any_of(cluster.begin(), cluster.end(), [&](int i) {
             return scan_.column[i] < 2 || scan_.column[i] + 2 >= scan_.num_columns;
           });
  }

 private:
  const LidarScan& scan_;
  bool has_sides_ = false;
};

}  // namespace

const char* class_by_size(const ClusterExtent& extent) {
  if (extent.length < 1.1F && within(extent.top, 1.2, 2.1)) return "person";
  if (within(extent.length, 1.3, 5.5) && extent.width < 2.3F && within(extent.top, 1.1, 2.2)) {
    return "car";
  }
  if (extent.length > 2 && extent.top > 2.4F) return "truck";
  return "object";
}

std::vector<int> road_user_clusters(const LidarScan& scan, const SceneSegments& segments,
                                    const ClusterDetectorOptions& options) {
  const bool has_ground = segments.ground.status == GroundStatus::found;
  const ViewEdge view_edge(scan, segments.horizontal_step_deg);
  std::vector<int> found;
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    const auto& cluster = segments.clusters[i];
    const ClusterExtent& extent = segments.extents[i];
    const double ring_m = std::tan(segments.vertical_step_deg * kDegree) * extent.centroid.norm();
    if (!has_size_of_road_user(extent, cluster.size(), has_ground, ring_m,
                               view_edge.cuts_off(cluster), options))
      continue;
    // The ring below may just have missed it.
    if (has_ground && extent.bottom > options.max_bottom + ring_m &&
        !foot_is_hidden(scan, segments.ground, cluster))
      continue;
    found.push_back(static_cast<int>(i));
  }
  return found;
}

}  // namespace lidar_upsampling
