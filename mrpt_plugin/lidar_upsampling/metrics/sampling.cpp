// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/sampling.h"

#include <algorithm>
#include <limits>
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

std::vector<Eigen::Vector3f> sample_points(const std::vector<Eigen::Vector3f>& points,
                                           std::size_t count, std::uint64_t seed) {
  if (points.empty() && count > 0) {
    throw std::invalid_argument("sample_points: " + std::to_string(count) +
                                " points asked of an empty cloud");
  }
  std::mt19937_64 random(seed);
  std::vector<Eigen::Vector3f> sample = points;
  for (std::size_t i = 0; i < std::min(count, points.size()); ++i) {
    std::swap(sample[i], sample[i + draw_below(points.size() - i, random)]);
  }
  sample.resize(std::min(count, points.size()));
  while (sample.size() < count) sample.push_back(points[draw_below(points.size(), random)]);
  return sample;
}

}  // namespace lidar_upsampling
