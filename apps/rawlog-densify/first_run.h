// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>

#include "densify.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/objects/mover_history.h"

namespace lidar_upsampling {

/// @brief Runs over the log only to see what moves (`mode = offline` with `hindsight`); nothing is
/// written.
/// @param progress gets the share done, 0 to 1.
[[nodiscard]] MoverHistory find_movers(const DensifyJob& job, const LogIndex& index,
                                       const std::function<void(double)>& progress);

}  // namespace lidar_upsampling
