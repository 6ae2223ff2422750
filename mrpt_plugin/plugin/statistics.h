// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace lidar_upsampling {

/// @brief Times in ms, kept to a tenth, so that a sensor may run for months.
class Latencies {
 public:
  void add(double ms);
  [[nodiscard]] std::size_t count() const { return count_; }
  /// @param share 0 to 1: 0.5 is the median, 1 the longest. @return 0 without any duration.
  [[nodiscard]] double quantile_ms(double share) const;

 private:
  std::map<int, std::size_t> tenths_;
  std::size_t count_ = 0;
};

/// What a live sensor did so far.
struct SensorStatistics {
  std::size_t num_real = 0;    ///< observations of all sources
  std::size_t num_scans = 0;   ///< of them, of the LiDAR
  std::size_t num_images = 0;  ///< of them, of the cameras
  std::size_t num_virtual_scans = 0;
  std::size_t num_hurried = 0;       ///< images on which nothing was followed, to catch up
  std::size_t num_late_images = 0;   ///< passed on without a virtual scan, as the work fell behind
  std::size_t num_late_scans = 0;    ///< passed on without becoming a key scan, likewise
  std::size_t num_out_of_order = 0;  ///< arrived after a later one had been passed on
  Latencies ready;                   ///< from an image's arrival until its virtual scan is made
  Latencies delivered;               ///< the same, until it is handed out
};

/// A few lines for people.
[[nodiscard]] std::string summary(const SensorStatistics& statistics);

}  // namespace lidar_upsampling
