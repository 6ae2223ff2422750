// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief What the threads have to tell, until the sensor's own thread logs it. A flood is cut off.
class Messages {
 public:
  void add(const std::string& text);
  [[nodiscard]] std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> texts_;
  std::size_t num_added_ = 0;
};

}  // namespace lidar_upsampling
