// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "figures.h"
#include "plots.h"

namespace lidar_upsampling {

/// @brief Position errors of objects by horizon, range and number of points: median and quartiles
/// of each row; moving and static ones apart.
[[nodiscard]] std::vector<Plot> binned_plots(const Figures& figures);

/// Which share of the objects has at most which position error; moving and static ones apart.
[[nodiscard]] std::vector<Plot> distribution_plots(const LogResult& result);

}  // namespace lidar_upsampling
