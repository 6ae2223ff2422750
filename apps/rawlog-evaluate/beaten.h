// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "figures.h"

namespace lidar_upsampling {

/// Figures in which a baseline that a user could take instead beats ours, in words, with the reason
/// where one is known.
[[nodiscard]] std::vector<std::string> beaten_figures(const LogResult& result,
                                                      const PerRow<RowFigures>& rows);

}  // namespace lidar_upsampling
