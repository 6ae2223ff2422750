// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>

namespace lidar_upsampling {

[[nodiscard]] inline double log_odds_of(double probability) {
  return std::log(probability / (1 - probability));
}

[[nodiscard]] inline double probability_of(double log_odds) {
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace lidar_upsampling
