// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/summary.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace lidar_upsampling {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const auto high = std::min(low + 1, sorted.size() - 1);
  const double rest = place - static_cast<double>(low);
  return (1 - rest) * sorted[low] + rest * sorted[high];
}

}  // namespace

ErrorSummary summarize(std::vector<double> values) {
  ErrorSummary summary;
  summary.count = static_cast<int>(values.size());
  if (values.empty()) {
    return summary;
  }
  std::sort(values.begin(), values.end());
  summary.mean =
      std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
  summary.median = quantile(values, 0.5);
  summary.p95 = quantile(values, 0.95);
  summary.q1 = quantile(values, 0.25);
  summary.q3 = quantile(values, 0.75);
  return summary;
}

std::vector<double> range_edges() { return {0, 10, 20, 30, 50, kInfinity}; }

std::vector<double> point_count_edges() {
  return {0, 10, 32, 100, 316, 1000, 3162, 10000, kInfinity};
}

std::vector<ErrorBin> bin_errors(const std::vector<KeyedError>& errors,
                                 const std::vector<double>& edges) {
  std::vector<std::vector<double>> values(edges.size() - 1);
  for (const auto& [key, error] : errors) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), key);
    if (key == key && above != edges.begin() && above != edges.end()) {
      values[above - edges.begin() - 1].push_back(error);
    }
  }
  std::vector<ErrorBin> bins(values.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i] = {edges[i], edges[i + 1], summarize(std::move(values[i]))};
  }
  return bins;
}

}  // namespace lidar_upsampling
