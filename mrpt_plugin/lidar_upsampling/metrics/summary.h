// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

namespace lidar_upsampling {

/// Zero if there are none.
struct ErrorSummary {
  int count = 0;
  double mean = 0, median = 0, p95 = 0;
  double q1 = 0, q3 = 0;  ///< quartiles
};

[[nodiscard]] ErrorSummary summarize(std::vector<double> values);

/// An error, and what it is to be sorted by (range, number of points, horizon).
struct KeyedError {
  double key = 0;
  double error = 0;
};

/// Errors whose key lies in [from, to).
struct ErrorBin {
  double from = 0, to = 0;
  ErrorSummary errors;
};

/// 0, 10, 20, 30, 50 m and beyond.
[[nodiscard]] std::vector<double> range_edges();

/// Half decades, as in the paper's error figures: 0, 10, 32, 100, 316, ... 10000 points and beyond.
[[nodiscard]] std::vector<double> point_count_edges();

/// @brief A summary for each pair of neighbouring edges, empty bins too. Keys outside go nowhere.
/// @param edges ascending, at least two; the last may be infinite.
[[nodiscard]] std::vector<ErrorBin> bin_errors(const std::vector<KeyedError>& errors,
                                               const std::vector<double>& edges);

}  // namespace lidar_upsampling
