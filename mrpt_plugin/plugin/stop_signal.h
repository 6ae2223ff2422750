// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace lidar_upsampling {

/// A sleep that another thread can end.
class StopSignal {
 public:
  void stop();
  /// @return whether it was stopped.
  [[nodiscard]] bool wait_until(std::chrono::steady_clock::time_point end);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopped_ = false;
};

}  // namespace lidar_upsampling
