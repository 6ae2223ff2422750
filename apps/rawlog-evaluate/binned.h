// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "figures.h"

namespace lidar_upsampling {

/// Position errors by horizon, range and number of points: of moving objects, then of standing
/// ones.
[[nodiscard]] std::vector<Binned> binned_errors(const LogResult& result);

}  // namespace lidar_upsampling
