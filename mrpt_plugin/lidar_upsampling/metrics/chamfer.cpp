// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/chamfer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>
#include <string>

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

std::vector<float> sq_distances(const std::vector<Eigen::Vector3f>& from, const PointIndex& to) {
  std::vector<float> result;
  for (const auto& neighbor : nearest_neighbors(from, to)) result.push_back(neighbor.sq_distance);
  return result;
}

}  // namespace

std::vector<PointIndex::Neighbor> nearest_neighbors(const std::vector<Eigen::Vector3f>& from,
                                                    const PointIndex& to,
                                                    const std::vector<float>* beside) {
  std::vector<PointIndex::Neighbor> neighbors(from.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      neighbors[i] = beside != nullptr ? to.nearest(from[i], (*beside)[i]) : to.nearest(from[i]);
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
  return chamfer_of(sq_distances(first, PointIndex(second)),
                    sq_distances(second, PointIndex(first)));
}

}  // namespace lidar_upsampling
