// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/chamfer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace lidar_upsampling {

namespace {

struct OneWay {
  double mean = 0;
  double mean_sq = 0;
};

// Summed in order: a parallel sum would depend on the number of threads.
OneWay one_way(const std::vector<float>& sq_distances) {
  OneWay sum;
  for (const float sq_distance : sq_distances) {
    sum.mean += std::sqrt(static_cast<double>(sq_distance));
    sum.mean_sq += sq_distance;
  }
  const auto count = static_cast<double>(sq_distances.size());
  return {sum.mean / count, sum.mean_sq / count};
}

// Points of a scan lie beside the one before: no nearest point is further than its, and the way.
class NearestOfRow {
 public:
  explicit NearestOfRow(const PointIndex& to) : to_(to) {}

  PointIndex::Neighbor of(const Eigen::Vector3f& point, float limit) {
    const float reach = last_distance_ + (point - last_).norm();
    // A thousandth more, for rounding.
    const float bound = std::min(limit, 1.001F * reach * reach + 1e-6F);
    PointIndex::Neighbor found = to_.nearest(point, bound);
    if (found.index < 0 && bound < limit) found = to_.nearest(point, limit);
    if (found.index < 0) return {-1, limit};
    last_ = point;
    last_distance_ = std::sqrt(found.sq_distance);
    return found;
  }

 private:
  const PointIndex& to_;
  Eigen::Vector3f last_ = Eigen::Vector3f::Zero();
  float last_distance_ = std::sqrt(std::numeric_limits<float>::max()) / 4;
};

std::vector<float> sq_distances_of(const std::vector<PointIndex::Neighbor>& neighbors) {
  std::vector<float> sq_distances;
  sq_distances.reserve(neighbors.size());
  for (const auto& neighbor : neighbors) sq_distances.push_back(neighbor.sq_distance);
  return sq_distances;
}

}  // namespace

std::vector<PointIndex::Neighbor> nearest_neighbors(const std::vector<Eigen::Vector3f>& from,
                                                    const PointIndex& to,
                                                    const std::vector<float>* beside) {
  std::vector<PointIndex::Neighbor> neighbors(from.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), 1024), [&](const auto& range) {
    NearestOfRow nearest(to);
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      neighbors[i] =
          nearest.of(from[i], beside != nullptr ? (*beside)[i] : std::numeric_limits<float>::max());
  });
  return neighbors;
}

Chamfer chamfer_of(const std::vector<float>& forward_sq, const std::vector<float>& backward_sq) {
  if (forward_sq.empty() || backward_sq.empty()) {
    throw std::invalid_argument(
        "Chamfer distance of an empty cloud: " + std::to_string(forward_sq.size()) + " and " +
        std::to_string(backward_sq.size()) + " points");
  }
  const OneWay forward = one_way(forward_sq), backward = one_way(backward_sq);
  return {forward.mean, backward.mean, forward.mean_sq, backward.mean_sq};
}

Chamfer compute_chamfer(const std::vector<Eigen::Vector3f>& first,
                        const std::vector<Eigen::Vector3f>& second) {
  if (first.empty() || second.empty())
    return chamfer_of(std::vector<float>(first.size()), std::vector<float>(second.size()));
  std::optional<PointIndex> index_first, index_second;
  tbb::parallel_invoke([&] { index_first.emplace(first); }, [&] { index_second.emplace(second); });
  return chamfer_of(sq_distances_of(nearest_neighbors(first, *index_second)),
                    sq_distances_of(nearest_neighbors(second, *index_first)));
}

}  // namespace lidar_upsampling
