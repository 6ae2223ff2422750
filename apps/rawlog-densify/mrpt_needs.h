// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "densify.h"

namespace lidar_upsampling {

/// A release of MRPT, as "2.5" or "2.15.7".
struct MrptRelease {
  std::vector<int> numbers;

  bool operator<(const MrptRelease& other) const { return numbers < other.numbers; }
};

/// @throw std::invalid_argument it is none.
[[nodiscard]] MrptRelease parse_release(const std::string& text);

/// A setting whose logs older releases cannot read: they end there without a word.
struct MrptNeed {
  std::string setting, since;
};

/// Of the virtual scans and the whole log's packing; what of the input goes through is as it was.
[[nodiscard]] std::vector<MrptNeed> needs_of(const Config& config);

/// @throw std::runtime_error a setting that `release` cannot read, and what does.
void check_readable_by(const MrptRelease& release, const Config& config);

/// Says in a line for each what older releases cannot read.
void warn_of_newer_mrpt(const Config& config, DensifyReport& report);

}  // namespace lidar_upsampling
