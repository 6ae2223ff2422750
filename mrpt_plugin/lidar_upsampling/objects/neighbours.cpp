// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/neighbours.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <nanoflann.hpp>

#include "lidar_upsampling/registration/voxel_grid.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Stand-ins for the points of one voxel each, with heights squeezed where rings lie far apart.
struct Representatives {
  std::vector<Eigen::Vector3f> points;
  std::vector<float>
      sq_reach;  ///< squared distance within which a neighbour belongs to the same object

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
  std::vector<Eigen::Vector3f> selected;
  selected.reserve(indices.size());
  for (const int index : indices) selected.push_back(points[index]);
  VoxelGroups voxels = group_by_voxel(selected, options.voxel_size);
  Representatives groups{std::move(voxels.means), {}};
  set_reach(groups, options);
  Neighbourhoods result;
  result.links = find_links(groups);
  result.representative = std::move(voxels.of_point);
  result.num_representatives = static_cast<int>(groups.points.size());
  return result;
}

}  // namespace lidar_upsampling
