// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <set>
#include <string>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/log_index.h"

namespace lidar_upsampling {

constexpr double kMostEgoGap_s = 2;  ///< between samples, that is looked over
constexpr double kEgoMemory_s = 5;   ///< what is longer past is forgotten

constexpr double kLate_s = 0.5;  ///< that an observation may come behind others of its time

/// How far to look ahead in a log: to an instant's next sample of the vehicle's motion, if it
/// counts, and some more for observations that come late.
[[nodiscard]] double span_ahead_s(const Config& config);

/// The streams whose stamps are asked for ahead of their turn: of scans, and those that may tell
/// the vehicle's motion.
[[nodiscard]] std::set<std::string> streams_ahead(const LogIndex& index);

/// @brief Whether the vehicle's motion can be taken while a log goes by, as samples close to an
/// instant tell it; else all of it must be known first, which takes memory as the log is long.
/// @param streams as index_streams()
[[nodiscard]] bool ego_goes_by(const Config& config, const LogIndex& streams);

}  // namespace lidar_upsampling
