// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/road_users.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lidar_upsampling/azimuth.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Directions below a cluster as the sensor sees them: tangents against the vertical plane through
/// its middle and against the horizontal.
struct Window {
  Eigen::Vector2f ahead;            ///< unit, towards the middle
  float left = 0, right = 0;        ///< of the azimuth
  float foot = 0, lowest = 0;       ///< of the elevation
  float nearest = 0, farthest = 0;  ///< m, horizontal range of the cluster
};

Window window_below(const LidarScan& scan, const Ground& ground, const std::vector<int>& cluster) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float height = 0;
  for (const int i : cluster) {
    sum += scan.points[i];
    height += ground.height[i];
  }
  const auto count = static_cast<float>(cluster.size());
  const Eigen::Vector3f foot = sum / count - height / count * ground.plane.normal.cast<float>();
  Window window{foot.head<2>().normalized(), -kFar, kFar, 0, kFar, kFar, 0};
  window.foot = foot.z() / foot.head<2>().norm();
  for (const int i : cluster) {
    const Eigen::Vector3f& point = scan.points[i];
    const float range = point.head<2>().norm();
    const float side = tangent_from(window.ahead, point);
    window.left = std::max(window.left, side);
    window.right = std::min(window.right, side);
    window.lowest = std::min(window.lowest, point.z() / range);
    window.nearest = std::min(window.nearest, range);
    window.farthest = std::max(window.farthest, range);
  }
  return window;
}

/// How far away a scan's points are, horizontally, and the tangents of their elevations.
class Elevations {
 public:
  explicit Elevations(const LidarScan& scan) : range_(scan.size()), slope_(scan.size(), kNowhere) {
    blocks_.resize((scan.size() + kBlock - 1) / kBlock);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      range_[i] = scan.points[i].head<2>().norm();
      if (!(range_[i] > 0)) continue;
      slope_[i] = scan.points[i].z() / range_[i];
      Block& block = blocks_[i / kBlock];
      block.lowest = std::min(block.lowest, slope_[i]);
      block.highest = std::max(block.highest, slope_[i]);
    }
  }

  /// Calls `action(point, range)` for each point between, both excluded.
  template <typename Action>
  void for_each_between(float low, float high, const Action& action) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (blocks_[b].highest <= low || blocks_[b].lowest >= high) continue;
      const std::size_t end = std::min(slope_.size(), (b + 1) * kBlock);
      for (std::size_t i = b * kBlock; i < end; ++i)
        if (slope_[i] > low && slope_[i] < high) action(i, range_[i]);
    }
  }

 private:
  static constexpr std::size_t kBlock = 64;
  static constexpr float kNowhere = std::numeric_limits<float>::infinity();
  struct Block {
    float lowest = kNowhere, highest = -kNowhere;
  };

  std::vector<float> range_, slope_;
  std::vector<Block> blocks_;  // what a stretch of points spans: most hold none that is asked for
};

bool within(double value, double low, double high) { return value >= low && value <= high; }

/// How far apart beams are where a cluster lies, m.
struct BeamGaps {
  double ring = 0, column = 0;
};

bool is_person(const ClusterExtent& extent) {
  return extent.length < 1.1F && within(extent.top, 1.2, 2.1);
}

/// But for where it begins above the ground. What one ring shows reaches up to the next, and a
/// person half a step beyond the columns that show him; poles are taller. One that the sensor's
/// view cuts off may be longer than it seems, `is_part`.
const char* why_not_by_size(const ClusterExtent& extent, std::size_t num_points, bool has_ground,
                            const BeamGaps& gaps, bool is_part,
                            const ClusterDetectorOptions& options) {
  const double range = extent.centroid.head<2>().norm();
  if (static_cast<int>(num_points) < options.min_points) return "too_few_points";
  if (range < options.min_range) return "too_near";
  if (range > options.max_range) return "too_far";
  const double aside = is_person(extent) ? gaps.column : 0;
  if (!is_part && extent.length + aside < options.min_length) return "too_short";
  if (extent.length > options.max_length) return "too_long";
  if (extent.width > options.max_width) return "too_wide";
  const double reach = has_ground && extent.height() < gaps.ring / 2 ? gaps.ring : 0;
  const double top = has_ground ? extent.top : extent.height();
  if (top + reach < (has_ground ? options.min_height : options.min_height / 2)) return "too_low";
  return top > options.max_height ? "too_high" : nullptr;
}

/// Whether a cluster lies at a side of a view that does not go all around.
bool is_cut_off(const LidarScan& scan, const std::optional<double>& horizontal_step_deg,
                const std::vector<int>& cluster) {
  constexpr double kAround_deg = 350;
  if (!horizontal_step_deg || *horizontal_step_deg * scan.num_columns >= kAround_deg) return false;
  return std::any_of(cluster.begin(), cluster.end(), [&](int i) {
    return scan.column[i] < 2 || scan.column[i] + 2 >= scan.num_columns;
  });
}

bool foot_is_hidden(const LidarScan& scan, const Elevations& elevations, const Ground& ground,
                    const std::vector<int>& cluster) {
  constexpr float kMargin = 0.5F;  // m, what is as far away is part of it
  constexpr int kHiddenPerSeen = 3;
  const Window window = window_below(scan, ground, cluster);
  int num_hidden = 0;
  int num_seen = 0;
  elevations.for_each_between(window.foot, window.lowest, [&](std::size_t i, float range) {
    const Eigen::Vector3f& point = scan.points[i];
    const float range_ahead = window.ahead.dot(point.head<2>());
    if (range_ahead <= 0) return;
    const float side = tangent_from(window.ahead, point);
    if (side > window.left || side < window.right) return;
    num_hidden += static_cast<int>(range < window.nearest - kMargin);
    num_seen += static_cast<int>(range > window.farthest + kMargin);
  });
  return num_hidden > kHiddenPerSeen * num_seen;
}

}  // namespace

bool foot_is_hidden(const LidarScan& scan, const Ground& ground, const std::vector<int>& cluster) {
  return foot_is_hidden(scan, Elevations(scan), ground, cluster);
}

const char* class_by_size(const ClusterExtent& extent) {
  if (is_person(extent)) return "person";
  if (within(extent.length, 1.3, 5.5) && extent.width < 2.3F && within(extent.top, 1.1, 2.2)) {
    return "car";
  }
  if (extent.length > 2 && extent.top > 2.4F) return "truck";
  if (extent.length < 1.3F && extent.top > 2.4F) return "pole";
  return "object";
}

std::vector<const char*> why_no_road_users(const LidarScan& scan, const SceneSegments& segments,
                                           const ClusterDetectorOptions& options) {
  const bool has_ground = segments.ground.status == GroundStatus::found;
  std::vector<const char*> why;
  std::vector<std::size_t> afloat;
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    const auto& cluster = segments.clusters[i];
    const ClusterExtent& extent = segments.extents[i];
    const double range = extent.centroid.norm();
    const BeamGaps gaps{
        std::tan(segments.vertical_step_deg * kDegree) * range,
        segments.horizontal_step_deg.value_or(ClusterOptions{}.horizontal_step_deg) * kDegree *
            range};
    why.push_back(why_not_by_size(extent, cluster.size(), has_ground, gaps,
                                  is_cut_off(scan, segments.horizontal_step_deg, cluster),
                                  options));
    // The ring below may just have missed it.
    if (why.back() == nullptr && has_ground && extent.bottom > options.max_bottom + gaps.ring)
      afloat.push_back(i);
  }
  if (afloat.empty()) return why;
  const Elevations elevations(scan);
  tbb::parallel_for(std::size_t{0}, afloat.size(), [&](std::size_t k) {
    const auto& cluster = segments.clusters[afloat[k]];
    if (!foot_is_hidden(scan, elevations, segments.ground, cluster))
      why[afloat[k]] = "above_the_ground";
  });
  return why;
}

}  // namespace lidar_upsampling
