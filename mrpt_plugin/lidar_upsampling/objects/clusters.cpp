// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/clusters.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/objects/cluster_extent.h"
#include "lidar_upsampling/objects/column_grid.h"
#include "lidar_upsampling/registration/voxel_grid.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Two neighbours; `ratio` of their squared distance to the squared reach of the further reaching
/// one.
struct Link {
  int a, b;
  float ratio;
};
using Links = std::vector<Link>;

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
std::vector<Links> find_links(const std::vector<Eigen::Vector3f>& points,
                              const std::vector<float>& sq_reach) {
  const float farthest = std::sqrt(*std::max_element(sq_reach.begin(), sq_reach.end()));
  const ColumnGrid grid(points, farthest / 2);
  tbb::enumerable_thread_specific<Links> links;
  tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(points.size()), 512),
                    [&](const auto& part) {
                      Links& noted = links.local();
                      for (int place = part.begin(); place < part.end(); ++place) {
                        const int i = grid.point[place];
                        const float mine = sq_reach[i];
                        grid.for_each_within(place, mine, [&](int other, float sq_distance) {
                          const float theirs = sq_reach[other];
                          if (theirs < mine || (theirs == mine && other < i))
                            noted.push_back({i, other, sq_distance / mine});
                        });
                      }
                    });
  return {links.begin(), links.end()};
}

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> parent_;
};

/// For each level of splitting, the component of each representative; what the threads found in
/// which order does not matter.
std::vector<DisjointSets> connect(const std::vector<Links>& links, std::size_t size,
                                  const ClusterOptions& options) {
  std::vector<DisjointSets> levels(options.max_splits + 1, DisjointSets(size));
  tbb::parallel_for(std::size_t{0}, levels.size(), [&](std::size_t level) {
    const auto max_ratio =
        static_cast<float>(std::pow(options.split_shrink, 2 * static_cast<double>(level)));
    for (const Links& some : links)
      for (const Link& link : some)
        if (link.ratio <= max_ratio) levels[level].join(link.a, link.b);
  });
  return levels;
}

using Clusters = std::vector<std::vector<int>>;

/// Splits `members`, positions in `indices`, by the components of a level, and what is too large of
/// them by the next.
class Splitter {
 public:
  Splitter(const std::vector<Eigen::Vector3f>& points, const std::vector<int>& indices,
           const ClusterOptions& options)
      : points_(points), indices_(indices), options_(options) {
    std::vector<Eigen::Vector3f> selected;
    selected.reserve(indices.size());
    for (const int index : indices) selected.push_back(points[index]);
    VoxelGroups voxels = group_by_voxel(selected, options.voxel_size);
    const std::vector<float> sq_reach = sq_reaches(voxels.means, options);
    levels_ = connect(find_links(voxels.means, sq_reach), sq_reach.size(), options);
    representative_ = std::move(voxels.of_point);
    part_of_.assign(sq_reach.size(), kNone);
  }

  Clusters run() {
    std::vector<int> all(indices_.size());
    std::iota(all.begin(), all.end(), 0);
    split(all, 0);
    return std::move(clusters_);
  }

 private:
  void split(const std::vector<int>& members, std::size_t level) {
    for (const std::vector<int>& part : parts_of(members, level)) {
      if (static_cast<int>(part.size()) < options_.min_points) continue;
      std::vector<int> cluster;
      cluster.reserve(part.size());
      for (const int member : part) cluster.push_back(indices_[member]);
      if (level + 1 < levels_.size() && is_too_large(cluster)) {
        split(part, level + 1);
      } else {
        if (!std::is_sorted(cluster.begin(), cluster.end()))
          std::sort(cluster.begin(), cluster.end());
        clusters_.push_back(std::move(cluster));
      }
    }
  }

  Clusters parts_of(const std::vector<int>& members, std::size_t level) {
    Clusters parts;
    std::vector<int> roots;  // of each part
    for (const int member : members) {
      const int root = levels_[level].find(representative_[member]);
      if (part_of_[root] == kNone) {
        part_of_[root] = static_cast<int>(parts.size());
        parts.emplace_back();
        roots.push_back(root);
      }
      parts[part_of_[root]].push_back(member);
    }
    for (const int root : roots) part_of_[root] = kNone;
    return parts;
  }

  [[nodiscard]] bool is_too_large(const std::vector<int>& cluster) const {
    Eigen::AlignedBox3f upright;
    for (const int index : cluster) upright.extend(points_[index]);
    const Eigen::Vector3f sides = upright.sizes();
    const double longest = std::max(sides.x(), sides.y());
    const double max_length =
        sides.z() > options_.low_height ? options_.max_length : options_.max_low_length;
    // The costly footprint is needed only where a turned one could be either.
    if (longest <= std::min(max_length, options_.max_width)) return false;
    if (longest > std::hypot(max_length, options_.max_width)) return true;
    const ClusterExtent extent = cluster_extent(points_, {}, cluster);
    return extent.length > max_length || extent.width > options_.max_width;
  }

  const std::vector<Eigen::Vector3f>& points_;
  const std::vector<int>& indices_;
  const ClusterOptions& options_;
  std::vector<int> representative_;  // of each position: one for each voxel
  std::vector<DisjointSets> levels_;
  static constexpr int kNone = -1;
  std::vector<int> part_of_;  // of each root, while parts are made
  Clusters clusters_;
};

void check(const ClusterOptions& options) {
  if (!(options.min_distance > 0 && options.max_distance >= options.min_distance &&
        options.voxel_size > 0 && options.distance_per_range >= 0 && options.beam_gaps >= 0 &&
        options.max_splits >= 0)) {
    throw std::invalid_argument(
        "clusters: need 0 < min_distance (" + std::to_string(options.min_distance) +
        " m) <= max_distance (" + std::to_string(options.max_distance) + " m), voxel_size (" +
        std::to_string(options.voxel_size) + " m) and the growth with range not negative");
  }
}

}  // namespace

std::vector<std::vector<int>> euclidean_clusters(const std::vector<Eigen::Vector3f>& points,
                                                 const std::vector<int>& indices,
                                                 const ClusterOptions& options) {
  check(options);
  if (indices.empty()) return {};
  Clusters clusters = Splitter(points, indices, options).run();
  std::sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return clusters;
}

}  // namespace lidar_upsampling
