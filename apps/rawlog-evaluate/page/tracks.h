// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>

#include "plots.h"
#include "run_report.h"

namespace lidar_upsampling {

/// Speeds over time of the moving objects that were followed longest; none if nothing moved.
[[nodiscard]] std::optional<Plot> speed_plot(const RunReport& report);

/// @brief Counts, statuses and a table of tracks.
/// @param speeds the drawn speed_plot(); empty: none.
[[nodiscard]] std::string tracks_html(const RunReport& report, const std::string& speeds);

}  // namespace lidar_upsampling
