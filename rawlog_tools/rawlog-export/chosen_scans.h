// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::exporting {

/// Which scans of a log are wanted.
struct Choice {
  std::string label;                 ///< empty: the virtual scans'
  std::optional<std::size_t> index;  ///< the one of this number among the label's, from 0
  std::optional<Stamp> stamp;        ///< the nearest one to this instant
};

struct ReadScans {
  std::size_t count = 0;              ///< that were handed over
  UnusedCounts unused;                ///< of those that are of no use
  std::optional<std::string> damage;  ///< of the log, where that is accepted
};

/// @brief Hands over the chosen scans in the log's order.
/// @param progress gets the share read, 0 to 1.
/// @throw std::runtime_error no such label, with those there are; no such index; a broken log.
ReadScans for_each_chosen_scan(const LogFile& log, const Choice& choice,
                               const std::function<void(double)>& progress,
                               const std::function<void(const LidarScan&)>& use);

}  // namespace lidar_upsampling::exporting
