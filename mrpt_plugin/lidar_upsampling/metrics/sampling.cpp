// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/sampling.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace lidar_upsampling {

namespace {

/// Evenly below `bound`, by rejection: the standard's distributions differ from library to library.
std::size_t draw_below(std::size_t bound, std::mt19937_64& random) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t end = kMax - kMax % bound;
  std::uint64_t value = random();
  while (value >= end) {
    value = random();
  }
  return value % bound;
}

}  // namespace

std::vector<int> sample_indices(std::size_t num_points, std::size_t count, std::uint64_t seed) {
  if (num_points == 0 && count > 0) {
    throw std::invalid_argument("sample_indices: " + std::to_string(count) +
                                " points asked of an empty cloud");
  }
  std::mt19937_64 random(seed);
  std::vector<int> indices(num_points);
  std::iota(indices.begin(), indices.end(), 0);
  for (std::size_t i = 0; i < std::min(count, num_points); ++i) {
    std::swap(indices[i], indices[i + draw_below(num_points - i, random)]);
  }
  indices.resize(std::min(count, num_points));
  while (indices.size() < count) {
    indices.push_back(static_cast<int>(draw_below(num_points, random)));
  }
  return indices;
}

std::vector<Eigen::Vector3f> sample_points(const std::vector<Eigen::Vector3f>& points,
                                           std::size_t count, std::uint64_t seed) {
  std::vector<Eigen::Vector3f> sample;
  sample.reserve(count);
  for (const int i : sample_indices(points.size(), count, seed)) {
    sample.push_back(points[i]);
  }
  return sample;
}

}  // namespace lidar_upsampling
