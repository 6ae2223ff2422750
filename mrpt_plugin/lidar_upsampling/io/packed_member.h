// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace lidar_upsampling {

/// A gzip member as it lies in a file; its checksum was right.
struct PackedMember {
  std::vector<std::uint8_t> bytes;
  std::size_t unpacked_size = 0;

  /// Larger ones, unpacked, are not kept: whoever packs a log as one stream has one member.
  static constexpr std::size_t kLargest = 4U << 20U;
};

/// @brief Whether some bytes end with what a member unpacks to, by its checksum.
[[nodiscard]] bool ends_with(const std::vector<std::uint8_t>& bytes, const PackedMember& member);

/// How an object that was read lies in the members of its file.
struct PlaceInMembers {
  std::shared_ptr<const PackedMember> ended;  ///< the one that ends with it; null: none does
  bool goes_on = false;                       ///< the one that it ends in may be copied as a whole
  bool is_all = false;                        ///< `ended` is, without looking at the object's bytes
};

}  // namespace lidar_upsampling
