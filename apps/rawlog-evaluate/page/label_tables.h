// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "label_table.h"

namespace lidar_upsampling {

/// @brief What labels tell, as tables: all labelled movers, those found, false movers, and movers
/// by class, range and speed. Empty without labels.
[[nodiscard]] std::vector<HtmlTable> label_tables(const LabelScores& scores);

/// One sentence on all labelled movers; empty without labels of row `ours`.
[[nodiscard]] std::string label_headline(const LabelScores& scores);

}  // namespace lidar_upsampling
