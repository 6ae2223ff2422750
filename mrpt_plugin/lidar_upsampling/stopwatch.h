// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <chrono>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Times a stage from its making to `stop()` or the end of its scope.
class Stopwatch {
 public:
  Stopwatch(std::vector<StageTime>& times, const char* stage) : times_(&times), stage_(stage) {}
  ~Stopwatch() { stop(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

  void stop() {
    if (times_ == nullptr) return;
    const std::chrono::duration<double, std::milli> passed = Clock::now() - start_;
    times_->push_back({stage_, passed.count()});
    times_ = nullptr;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageTime>* times_;
  const char* stage_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace lidar_upsampling
