// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace lidar_upsampling {

/// @brief How long something took each time, ms. Quantiles are good to half a percent, for memory
/// that does not grow with the log.
class Durations {
 public:
  void add(double ms) {
    ++num_of_class_[class_of(ms)];
    ++count_;
    total_ms_ += ms;
  }
  void add(const Durations& others) {
    for (const auto& [number, count] : others.num_of_class_) num_of_class_[number] += count;
    count_ += others.count_;
    total_ms_ += others.total_ms_;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double total_ms() const { return total_ms_; }

  /// The value that this share of them does not exceed; 0 of none.
  [[nodiscard]] double quantile(double share) const {
    if (count_ == 0) return 0;
    auto left = std::lround(share * static_cast<double>(count_ - 1));
    for (const auto& [number, count] : num_of_class_) {
      if (left < static_cast<long>(count)) return std::exp(number / kClassesPerE);
      left -= static_cast<long>(count);
    }
    return 0;
  }

 private:
  static constexpr double kClassesPerE = 100;  // of an e-fold
  static constexpr double kLeast_ms = 1e-4;

  static int class_of(double ms) {
    return static_cast<int>(std::lround(kClassesPerE * std::log(std::max(ms, kLeast_ms))));
  }

  std::map<int, std::size_t> num_of_class_;
  std::size_t count_ = 0;
  double total_ms_ = 0;
};

}  // namespace lidar_upsampling
