// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// The text without the `blanks` at its ends.
[[nodiscard]] inline std::string trimmed(const std::string& text, const char* blanks = " \t\r") {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What stands between the commas of a line, each trimmed; an empty one at the end is none.
[[nodiscard]] inline std::vector<std::string> comma_separated(const std::string& line,
                                                              const char* blanks = " \t\r") {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
    fields.push_back(trimmed(field, blanks));
  return fields;
}

}  // namespace lidar_upsampling
