// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief What the threads have to tell, until the sensor's own thread logs it: each text once, and
/// how often it was told at the end. A flood is cut off.
class Messages {
 public:
  void add(const std::string& text);
  [[nodiscard]] std::vector<std::string> take();
  /// What was told more than once, as "text (12x)".
  [[nodiscard]] std::vector<std::string> repeated() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
  std::map<std::string, std::size_t> counts_;
  bool is_cut_off_ = false;
};

}  // namespace lidar_upsampling
