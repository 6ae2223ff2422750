// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/beam_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr double kDefaultVerticalStepDeg = 0.4;

/// Elevations in bins of a quarter degree; rings that lie closer together leave no empty bins
/// between.
double step_from_elevations(const LidarScan& scan) {
  constexpr double kBin = 0.25;
  constexpr int kBins = 720;
  constexpr int kMinHits = 3;
  std::array<int, kBins> hits{};
  const std::size_t stride = std::max<std::size_t>(1, scan.size() / 20000);
  for (std::size_t i = 0; i < scan.size(); i += stride) {
    const Eigen::Vector3f& p = scan.points[i];
    const double elevation = std::atan2(p.z(), p.head<2>().norm()) / kDegree;
    ++hits[std::clamp(static_cast<int>((elevation + 90) / kBin), 0, kBins - 1)];
  }
  constexpr int kMinRings = 4;
  constexpr int kWidestRing = 4;  // bins
  int rings = 0;
  int first = -1;
  int last = -1;
  int width = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    if (hits[bin] < kMinHits) continue;
    const bool is_new = last < 0 || last != bin - 1;
    width = is_new ? 1 : width + 1;
    if (width > kWidestRing) return kDefaultVerticalStepDeg;
    rings += is_new ? 1 : 0;
    if (first < 0) first = bin;
    last = bin;
  }
  return rings < kMinRings ? kDefaultVerticalStepDeg : (last - first) * kBin / (rings - 1);
}

}  // namespace

double estimate_vertical_step_deg(const LidarScan& scan) {
  if (scan.num_rings < 2 || scan.ring.empty()) return step_from_elevations(scan);
  std::vector<int> count(scan.num_rings, 0);
  for (const std::uint16_t ring : scan.ring) ++count[ring];
  const auto has_points = [](int points) { return points > 0; };
  const auto first = std::find_if(count.begin(), count.end(), has_points);
  const auto last = std::find_if(count.rbegin(), count.rend(), has_points);
  const int lowest = static_cast<int>(first - count.begin());
  const int highest = static_cast<int>(count.rend() - last) - 1;
  if (highest <= lowest) return kDefaultVerticalStepDeg;
  double sum_lowest = 0, sum_highest = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.ring[i] != lowest && scan.ring[i] != highest) continue;
    const Eigen::Vector3f& p = scan.points[i];
    (scan.ring[i] == lowest ? sum_lowest : sum_highest) += std::atan2(p.z(), p.head<2>().norm());
  }
  const double span = sum_highest / count[highest] - sum_lowest / count[lowest];
  return std::abs(span) / kDegree / (highest - lowest);
}

std::optional<double> estimate_horizontal_step_deg(const LidarScan& scan) {
  constexpr int kEnough = 2000;  // pairs
  constexpr int kEveryRing = 4;
  if (scan.num_rings <= 0 || scan.column.size() != scan.size()) return std::nullopt;
  std::vector<std::ptrdiff_t> last(scan.num_rings, -1);  // point of each ring, in the scan's order
  std::vector<double> steps;
  for (std::size_t i = 0; i < scan.size() && steps.size() < kEnough; ++i) {
    if (scan.ring[i] % kEveryRing != 0) continue;
    const std::ptrdiff_t before = std::exchange(last[scan.ring[i]], i);
    if (before < 0 || std::abs(scan.column[i] - scan.column[before]) != 1) continue;
    const Eigen::Vector2f a = scan.points[before].head<2>(), b = scan.points[i].head<2>();
    steps.push_back(std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) / kDegree);
  }
  if (steps.empty()) return std::nullopt;
  return median(std::move(steps));
}

}  // namespace lidar_upsampling
