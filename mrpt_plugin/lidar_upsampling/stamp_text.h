// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A stamp as text: MRPT ticks (an integer), or UNIX seconds with decimals, read without
/// passing through a double.
/// @throw std::invalid_argument neither of the two.
[[nodiscard]] Stamp parse_stamp(const std::string& text);

/// UNIX seconds with all seven decimals, as `1317046450.1234567`.
[[nodiscard]] std::string to_text(Stamp stamp);

}  // namespace lidar_upsampling
