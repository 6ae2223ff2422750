// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

namespace lidar_upsampling {

// The tables that are printed: names of 40 characters, then columns of nine.

/// As printf, up to 255 characters.
__attribute__((format(printf, 1, 2))) std::string formatted(const char* format, ...);

/// The name of a line.
[[nodiscard]] std::string named(const std::string& name);

/// A figure, or a dash where there is none.
[[nodiscard]] std::string cell(bool known, double value, int digits = 3);

[[nodiscard]] std::string heading(const std::string& title,
                                  const std::vector<const char*>& columns);

/// "10 to 20 m", "50 m and more".
[[nodiscard]] std::string edges_of(double from, double to, const std::string& unit);

}  // namespace lidar_upsampling
