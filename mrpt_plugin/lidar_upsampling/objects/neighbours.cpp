// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/neighbours.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Stand-ins for the points of one voxel each, with heights squeezed where rings lie far apart.
struct Representatives {
  std::vector<Eigen::Vector3f> points;
  std::vector<float>
      sq_reach;  ///< squared distance within which a neighbour belongs to the same object
  std::vector<int> of_index;  ///< of each clustered index, its representative

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Representatives>,
                                        Representatives, 3, int>;

std::uint64_t voxel_key(const Eigen::Vector3f& point, float per_metre) {
  constexpr int kOffset = 1 << 20;
  constexpr std::uint64_t kMask = (1U << 21) - 1;
  std::uint64_t key = 0;
  for (const float x : {point.x(), point.y(), point.z()}) {
    key = (key << 21) | (static_cast<std::uint64_t>(std::floor(x * per_metre) + kOffset) & kMask);
  }
  return key;
}

/// Numbers keys from 0 as they first appear; std::unordered_map takes four times as long.
class KeyNumbering {
 public:
  explicit KeyNumbering(std::size_t max_keys) {
    std::size_t size = 16;
    while (size < 2 * max_keys) size *= 2;
    slots_.assign(size, {0, -1});
  }

  int number_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (key * 0x9E3779B97F4A7C15ULL >> 20) & mask;
    while (slots_[at].number >= 0 && slots_[at].key != key) at = (at + 1) & mask;
    if (slots_[at].number < 0) slots_[at] = {key, count_++};
    return slots_[at].number;
  }

 private:
  struct Slot {
    std::uint64_t key;
    int number;
  };
  std::vector<Slot> slots_;
  int count_ = 0;
};

/// The mean point of each voxel.
Representatives group_by_voxel(const std::vector<Eigen::Vector3f>& points,
                               const std::vector<int>& indices, double voxel_size) {
  Representatives groups;
  groups.of_index.reserve(indices.size());
  const auto per_metre = static_cast<float>(1 / voxel_size);
  KeyNumbering numbering(indices.size());
  std::vector<int> count;
  for (const int index : indices) {
    const int group = numbering.number_of(voxel_key(points[index], per_metre));
    if (group == static_cast<int>(count.size())) {
      groups.points.emplace_back(Eigen::Vector3f::Zero());
      count.push_back(0);
    }
    groups.points[group] += points[index];
    ++count[group];
    groups.of_index.push_back(group);
  }
  for (std::size_t i = 0; i < count.size(); ++i) groups.points[i] /= static_cast<float>(count[i]);
  return groups;
}

/// Sets how far each one reaches, and squeezes z so that one distance serves both directions.
void set_reach(Representatives& groups, const ClusterOptions& options) {
  groups.sq_reach.resize(groups.points.size());
  for (std::size_t i = 0; i < groups.points.size(); ++i) {
    Eigen::Vector3f& point = groups.points[i];
    const double range = point.norm();
    const double step = options.beam_gaps * kDegree * range;
    const double across =
        std::clamp(std::max(options.min_distance + options.distance_per_range * range,
                            step * options.horizontal_step_deg),
                   options.min_distance, options.max_distance);
    const double upright = std::max(across, step * options.vertical_step_deg);
    point.z() *= static_cast<float>(across / upright);
    groups.sq_reach[i] = static_cast<float>(across * across);
  }
}

/// What nanoflann reports the neighbours of one point to: a link is noted by the end that reaches
/// further.
class LinkCollector {
 public:
  using DistanceType = float;
  LinkCollector(int self, const std::vector<float>& sq_reach, Links& links)
      : self_(self), sq_reach_(sq_reach), links_(links) {}

  bool addPoint(float sq_distance, int other) {
    const float mine = sq_reach_[self_];
    const float theirs = sq_reach_[other];
    if (theirs < mine || (theirs == mine && other < self_))
      links_.push_back({self_, other, sq_distance / mine});
    return true;
  }
  [[nodiscard]] float worstDist() const { return sq_reach_[self_]; }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] std::size_t size() const { return links_.size(); }

 private:
  int self_;
  const std::vector<float>& sq_reach_;
  Links& links_;
};

std::vector<Links> find_links(const Representatives& groups) {
  const KdTree tree(3, groups, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  tbb::enumerable_thread_specific<Links> links;
  tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(groups.points.size()), 512),
                    [&](const auto& part) {
                      Links& mine = links.local();
                      for (int i = part.begin(); i < part.end(); ++i) {
                        LinkCollector collector(i, groups.sq_reach, mine);
                        tree.findNeighbors(collector, groups.points[i].data(), {});
                      }
                    });
  return {links.begin(), links.end()};
}

}  // namespace

Neighbourhoods find_neighbours(const std::vector<Eigen::Vector3f>& points,
                               const std::vector<int>& indices, const ClusterOptions& options) {
  Representatives groups = group_by_voxel(points, indices, options.voxel_size);
  set_reach(groups, options);
  Neighbourhoods result;
  result.links = find_links(groups);
  result.representative = std::move(groups.of_index);
  result.num_representatives = static_cast<int>(groups.points.size());
  return result;
}

}  // namespace lidar_upsampling
