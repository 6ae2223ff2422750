// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/chamfer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "lidar_upsampling/registration/point_index.h"

namespace lidar_upsampling {

namespace {

struct OneWay {
  double mean = 0;
  double mean_sq = 0;
};

OneWay one_way(const std::vector<Eigen::Vector3f>& from, const PointIndex& to) {
  std::vector<float> sq_distances(from.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      sq_distances[i] = to.nearest(from[i]).sq_distance;
    }
  });
  // Summed in order: a parallel sum would depend on the number of threads.
  OneWay sum;
  for (const float sq_distance : sq_distances) {
    sum.mean += std::sqrt(static_cast<double>(sq_distance));
    sum.mean_sq += sq_distance;
  }
  const auto count = static_cast<double>(from.size());
  return {sum.mean / count, sum.mean_sq / count};
}

}  // namespace

Chamfer compute_chamfer(const std::vector<Eigen::Vector3f>& first,
                        const std::vector<Eigen::Vector3f>& second) {
  if (first.empty() || second.empty()) {
    throw std::invalid_argument(
        "Chamfer distance of an empty cloud: " + std::to_string(first.size()) + " and " +
        std::to_string(second.size()) + " points");
  }
  std::optional<PointIndex> index_first, index_second;
  tbb::parallel_invoke([&] { index_first.emplace(first); }, [&] { index_second.emplace(second); });
  const OneWay forward = one_way(first, *index_second);
  const OneWay backward = one_way(second, *index_first);
  return {forward.mean, backward.mean, forward.mean_sq, backward.mean_sq};
}

}  // namespace lidar_upsampling
