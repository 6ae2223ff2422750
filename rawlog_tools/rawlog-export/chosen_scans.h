// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::exporting {

/// Which scans of a log are wanted.
struct Choice {
  std::string label;                 ///< empty: the virtual scans'
  std::optional<std::size_t> index;  ///< the one of this number among the label's, from 0
  std::optional<Stamp> stamp;        ///< the nearest one to this instant
};

/// @brief Hands over the chosen scans in the log's order.
/// @param progress gets the share read, 0 to 1.
/// @return their number.
/// @throw std::runtime_error no such label, with those there are; no such index; a broken log.
std::size_t for_each_chosen_scan(const std::string& path, const Choice& choice,
                                 const std::function<void(double)>& progress,
                                 const std::function<void(const LidarScan&)>& use);

}  // namespace lidar_upsampling::exporting
