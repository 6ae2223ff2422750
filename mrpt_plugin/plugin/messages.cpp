// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/messages.h"

#include <utility>

namespace lidar_upsampling {

void Messages::add(const std::string& text) {
  constexpr std::size_t kMost = 50;
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = counts_.find(text);
  if (known != counts_.end()) {
    ++known->second;
  } else if (counts_.size() < kMost) {
    counts_[text] = 1;
    texts_.push_back(text);
  } else if (!is_cut_off_) {
    texts_.emplace_back("further warnings are not shown");
    is_cut_off_ = true;
  }
}

std::vector<std::string> Messages::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(texts_, {});
}

std::vector<std::string> Messages::repeated() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> texts;
  for (const auto& [text, count] : counts_)
    if (count > 1) texts.push_back(text + " (" + std::to_string(count) + "x)");
  return texts;
}

}  // namespace lidar_upsampling
