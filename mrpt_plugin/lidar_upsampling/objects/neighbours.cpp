// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/neighbours.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/registration/voxel_grid.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// The squared distance within which each point's neighbours belong to the same object; squeezes z,
/// where rings lie far apart, so that one distance serves both directions.
std::vector<float> sq_reaches(std::vector<Eigen::Vector3f>& points, const ClusterOptions& options) {
  std::vector<float> sq_reach;
  sq_reach.reserve(points.size());
  for (Eigen::Vector3f& point : points) {
    const double range = point.norm();
    const double step = options.beam_gaps * kDegree * range;
    const double across =
        std::clamp(std::max(options.min_distance + options.distance_per_range * range,
                            step * options.horizontal_step_deg),
                   options.min_distance, options.max_distance);
    const double upright = std::max(across, step * options.vertical_step_deg);
    point.z() *= static_cast<float>(across / upright);
    sq_reach.push_back(static_cast<float>(across * across));
  }
  return sq_reach;
}

/// A link is noted by the end that reaches further.
std::vector<Links> find_links(const PointIndex& index, const std::vector<float>& sq_reach) {
  tbb::enumerable_thread_specific<Links> links;
  tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(sq_reach.size()), 512),
                    [&](const auto& part) {
                      Links& noted = links.local();
                      std::vector<PointIndex::Neighbor> around;
                      for (int i = part.begin(); i < part.end(); ++i) {
                        const float mine = sq_reach[i];
                        index.within(index.points()[i], mine, around);
                        for (const auto& [other, sq_distance] : around) {
                          const float theirs = sq_reach[other];
                          if (theirs < mine || (theirs == mine && other < i))
                            noted.push_back({i, other, sq_distance / mine});
                        }
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
  const std::vector<float> sq_reach = sq_reaches(voxels.means, options);
  Neighbourhoods result;
  result.links = find_links(PointIndex(std::move(voxels.means)), sq_reach);
  result.representative = std::move(voxels.of_point);
  result.num_representatives = static_cast<int>(sq_reach.size());
  return result;
}

}  // namespace lidar_upsampling
