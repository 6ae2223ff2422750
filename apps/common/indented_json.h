// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <string>

namespace lidar_upsampling {

/// @brief As a value that stands so many levels deep in another, for documents that are written
/// piece by piece. Bytes that are no UTF-8 are replaced.
template <typename Json>
[[nodiscard]] std::string indented(const Json& json, int depth) {
  const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace);
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result.append(static_cast<std::size_t>(depth), ' ');
  }
  return result;
}

}  // namespace lidar_upsampling
