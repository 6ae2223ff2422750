// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::maps {

/// @brief Hands over every scan of a log, real and virtual, in its order.
/// @return what there is to warn of: scans that are of no use, damage where that is accepted.
/// @throw std::runtime_error it cannot be read.
std::vector<std::string> for_each_scan(const LogFile& log,
                                       const std::function<void(const LidarScan&)>& use);

/// @brief The vehicle's way, from the log's poses or odometry; without them, each real scan
/// registered to the one before.
/// @throw std::runtime_error fewer than two poses, or two scans that cannot be registered.
[[nodiscard]] Trajectory trajectory_of(const LogFile& log);

}  // namespace lidar_upsampling::maps
