// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief For messages about a word that is not known: "; did you mean window_px?" of the known one
/// that the fewest letters tell apart from it; nothing where none is near.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& known);

}  // namespace lidar_upsampling
