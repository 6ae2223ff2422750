// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "text_table.h"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace lidar_upsampling {

std::string formatted(const char* format, ...) {
  std::array<char, 256> line{};
  va_list arguments;
  va_start(arguments, format);
  // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): va_start() is not seen through
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  return line.data();
}

std::string named(const std::string& name) { return formatted("  %-38s", name.c_str()); }

std::string cell(bool known, double value, int digits) {
  return known ? formatted("%9.*f", digits, value) : formatted("%9s", "-");
}

std::string heading(const std::string& title, const std::vector<const char*>& columns) {
  std::string line = formatted("\n%-40s", title.c_str());
  for (const char* column : columns) line += formatted(" %8s", column);
  return line + "\n";
}

std::string edges_of(double from, double to, const std::string& unit) {
  if (std::isinf(to)) return formatted("%.0f %s and more", from, unit.c_str());
  return formatted("%.0f to %.0f %s", from, to, unit.c_str());
}

}  // namespace lidar_upsampling
