// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "figures.h"
#include "html.h"

namespace lidar_upsampling {

/// @brief The terminal's tables for the page: errors of objects, then those of whole scans.
[[nodiscard]] std::vector<HtmlTable> object_tables(const Figures& figures);
[[nodiscard]] std::vector<HtmlTable> binned_tables(const Figures& figures);
[[nodiscard]] std::vector<HtmlTable> scan_tables(const Figures& figures);

/// The protocol's measures beside the published figures.
[[nodiscard]] std::vector<HtmlTable> protocol_tables(const Figures& figures,
                                                     const Protocol& protocol);

}  // namespace lidar_upsampling
