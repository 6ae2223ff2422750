// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

namespace lidar_upsampling {

/// What follows a LiDAR's label in that of its virtual scans.
constexpr const char* kVirtualEnding = "_VIRTUAL";

/// Whether virtual scans are labelled so, unless `output_label` tells otherwise: a real label,
/// which may be empty, and an ending.
[[nodiscard]] inline bool is_virtual_label(const std::string& label) {
  const std::string ending = kVirtualEnding;
  return label.size() >= ending.size() &&
         label.compare(label.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace lidar_upsampling
