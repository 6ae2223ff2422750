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
const char* why_not_by_size(const ClusterExtent& extent, std::size_t num_points, bool has_ground,
                            double ring_m, bool is_cut_off, const ClusterDetectorOptions& options) {
  const double range = extent.centroid.head<2>().norm();
  if (static_cast<int>(num_points) < options.min_points) return "too_few_points";
  if (range < options.min_range) return "too_near";
  if (range > options.max_range) return "too_far";
  if (!is_cut_off && extent.length < options.min_length) return "too_short";
  if (extent.length > options.max_length) return "too_long";
  if (extent.width > options.max_width) return "too_wide";
  const double reach = has_ground && extent.height() < ring_m / 2 ? ring_m : 0;
  const double top = has_ground ? extent.top : extent.height();
  if (top + reach < (has_ground ? options.min_height : options.min_height / 2)) return "too_low";
  return top > options.max_height ? "too_high" : nullptr;
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

std::vector<const char*> why_no_road_users(const LidarScan& scan, const SceneSegments& segments,
                                           const ClusterDetectorOptions& options) {
  const bool has_ground = segments.ground.status == GroundStatus::found;
  const ViewEdge view_edge(scan, segments.horizontal_step_deg);
  std::vector<const char*> why;
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    const auto& cluster = segments.clusters[i];
    const ClusterExtent& extent = segments.extents[i];
    const double ring_m = std::tan(segments.vertical_step_deg * kDegree) * extent.centroid.norm();
    why.push_back(why_not_by_size(extent, cluster.size(), has_ground, ring_m,
                                  view_edge.cuts_off(cluster), options));
    // The ring below may just have missed it.
    if (why.back() == nullptr && has_ground && extent.bottom > options.max_bottom + ring_m &&
        !foot_is_hidden(scan, segments.ground, cluster))
      why.back() = "above_the_ground";
  }
  return why;
}

std::vector<int> road_user_clusters(const LidarScan& scan, const SceneSegments& segments,
                                    const ClusterDetectorOptions& options) {
  const auto why = why_no_road_users(scan, segments, options);
  std::vector<int> found;
  for (std::size_t i = 0; i < why.size(); ++i)
    if (why[i] == nullptr) found.push_back(static_cast<int>(i));
  return found;
}

}  // namespace lidar_upsampling
