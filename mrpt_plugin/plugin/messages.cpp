// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/messages.h"

#include <utility>

namespace lidar_upsampling {

void Messages::add(const std::string& text) {
  constexpr std::size_t kMost = 50;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (num_added_ < kMost) texts_.push_back(text);
  if (num_added_ == kMost) texts_.emplace_back("further warnings are not shown");
  ++num_added_;
}

std::vector<std::string> Messages::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(texts_, {});
}

}  // namespace lidar_upsampling
