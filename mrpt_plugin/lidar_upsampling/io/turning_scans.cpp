// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/turning_scans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace lidar_upsampling {
namespace {

constexpr double kWholeTurn = 2 * M_PI;

using Rings = std::vector<std::vector<std::size_t>>;  // points of each, as they were measured

Rings split(const LidarScan& scan) {
  Rings rings(static_cast<std::size_t>(scan.num_rings));
  for (std::size_t i = 0; i < scan.size(); ++i) rings[scan.ring[i]].push_back(i);
  if (scan.time_s.empty()) return rings;
  for (auto& ring : rings)
    std::stable_sort(ring.begin(), ring.end(),
                     [&](std::size_t a, std::size_t b) { return scan.time_s[a] < scan.time_s[b]; });
  return rings;
}

double azimuth_of_point(const LidarScan& scan, std::size_t i) {
  return std::atan2(scan.points[i].y(), scan.points[i].x());
}

// The azimuth step along the rings, negative where it turns clockwise; none: there is no such one.
std::optional<double> common_step(const LidarScan& scan, const Rings& rings) {
  constexpr double kLargest = kWholeTurn / 90, kNear = 0.3, kShare = 0.4;
  std::vector<double> steps;
  for (const auto& ring : rings)
    for (std::size_t k = 1; k < ring.size(); ++k) {
      const double step = azimuth_of_point(scan, ring[k]) - azimuth_of_point(scan, ring[k - 1]);
      steps.push_back(std::remainder(step, kWholeTurn));
    }
  if (steps.empty()) return {};
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double step = *middle;
  const auto num_near = std::count_if(steps.begin(), steps.end(), [&](double other) {
    return std::abs(other - step) < kNear * std::abs(step);
  });
  const bool is_common = static_cast<double>(num_near) > kShare * static_cast<double>(steps.size());
  if (!is_common || step == 0 || std::abs(step) > kLargest) return {};
  return step;
}

// The part of a step by which a ring's points lie off whole ones: its laser sits elsewhere.
double offset_of(const std::vector<double>& places) {
  double sine = 0, cosine = 0;
  for (const double place : places) {
    sine += std::sin(kWholeTurn * place);
    cosine += std::cos(kWholeTurn * place);
  }
  return std::atan2(sine, cosine) / kWholeTurn;
}

// By all points together: of a moved scan a few rings may be out of order.
bool rings_go_down(const LidarScan& scan) {
  const double mean = std::accumulate(scan.ring.begin(), scan.ring.end(), 0.) /
                      static_cast<double>(scan.ring.size());
  double covariance = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    covariance += (scan.ring[i] - mean) * std::atan2(p.z(), p.head<2>().norm());
  }
  return covariance < -1e-6 * static_cast<double>(scan.size());
}

}  // namespace

void number_rings_upwards(LidarScan& scan) {
  if (scan.ring.empty() || !rings_go_down(scan)) return;
  for (std::uint16_t& ring : scan.ring)
    ring = static_cast<std::uint16_t>(scan.num_rings - 1 - ring);
}

void find_columns(LidarScan& scan) {
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  if (scan.ring.empty()) return;
  const Rings rings = split(scan);
  const auto step = common_step(scan, rings);
  if (!step) return;
  const auto number = static_cast<int>(std::lround(std::min(kMost, kWholeTurn / std::abs(*step))));
  scan.num_columns = number;
  scan.column.resize(scan.size());
  const double per_radian = (*step > 0 ? 1 : -1) * number / kWholeTurn;
  for (const auto& ring : rings) {
    std::vector<double> places;
    for (const std::size_t i : ring) places.push_back(azimuth_of_point(scan, i) * per_radian);
    const double offset = offset_of(places);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto column = static_cast<int>(std::lround(places[k] - offset)) % number;
      scan.column[ring[k]] = static_cast<std::uint16_t>(column < 0 ? column + number : column);
    }
  }
}

}  // namespace lidar_upsampling
