// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <optional>

namespace lidar_upsampling {

/// Where a member of a gzip file can be unpacked from.
struct GzipMember {
  std::uint64_t from = 0;  ///< byte of the file, where
  bool has_header = true;  ///< its header, or the data behind a damaged one begins
};

/// @brief The next member of an open file that can be unpacked, at least its begin.
/// @param from a byte of the file. @param expected one is to begin right there: it may be that
/// nothing but its header is damaged.
[[nodiscard]] std::optional<GzipMember> next_gzip_member(int file, std::uint64_t from,
                                                         bool expected);

}  // namespace lidar_upsampling
