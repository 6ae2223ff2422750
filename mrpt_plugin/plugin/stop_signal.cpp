// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/stop_signal.h"

namespace lidar_upsampling {

void StopSignal::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

bool StopSignal::wait_until(std::chrono::steady_clock::time_point end) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_until(lock, end, [this] { return stopped_; });
}

}  // namespace lidar_upsampling
