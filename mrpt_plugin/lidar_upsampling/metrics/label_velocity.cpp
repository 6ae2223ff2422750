// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/label_velocity.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/metrics/summary.h"

namespace lidar_upsampling {
namespace {

constexpr double kHalfWidth = 0.35;  // s
constexpr double kIntervals = 1.5;   // half width where labels are rarer
constexpr int kEnoughLabels = 5, kFewestLabels = 2;
constexpr double kHalfTick = 5e-8;  // s; of room for stamps that are just the half width away

double median_interval(const std::vector<Stamp>& stamps) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    intervals.push_back(seconds_between(stamps[i - 1], stamps[i]));
  }
  return intervals.empty() ? 0 : summarize(intervals).median;
}

// The greatest number of the stamps about one of them.
int most_in_window(const std::vector<Stamp>& stamps, double half_width) {
  const double reach = half_width + kHalfTick;
  std::ptrdiff_t most = 0;
  auto first = stamps.begin(), end = stamps.begin();
  for (const Stamp centre : stamps) {
    while (seconds_between(*first, centre) > reach) ++first;
    while (end != stamps.end() && seconds_between(centre, *end) <= reach) ++end;
    most = std::max(most, end - first);
  }
  return static_cast<int>(most);
}

}  // namespace

LabelWindow label_window(std::vector<Stamp> all_label_stamps) {
  std::vector<Stamp>& stamps = all_label_stamps;
  std::sort(stamps.begin(), stamps.end());
  stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
  LabelWindow window;
  window.half_width_s = std::max(kHalfWidth, kIntervals * median_interval(stamps));
  window.min_labels =
      std::clamp(most_in_window(stamps, window.half_width_s) - 1, kFewestLabels, kEnoughLabels);
  return window;
}

std::optional<FittedVelocity> fit_velocity(const std::vector<LabelledPosition>& track, Stamp stamp,
                                           const LabelWindow& window) {
  std::vector<double> times;
  std::vector<Eigen::Vector3d> positions;
  for (const LabelledPosition& label : track) {
    const double t = seconds_between(stamp, label.stamp);
    if (std::abs(t) > window.half_width_s + kHalfTick) continue;
    times.push_back(t);
    positions.push_back(label.position);
  }
  const auto num_labels = static_cast<int>(times.size());
  if (num_labels < std::max(kFewestLabels, window.min_labels)) return std::nullopt;
  double mean_time = 0;
  for (const double t : times) mean_time += t / num_labels;
  double spread = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i] - mean_time;
    spread += t * t;
    // Less the first: a city's coordinates have digits to lose.
    slope += t * (positions[i] - positions[0]);
  }
  if (!(spread > kHalfTick * kHalfTick)) return std::nullopt;
  return FittedVelocity{slope / spread, num_labels};
}

}  // namespace lidar_upsampling
