// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What of a damaged log was left out, for one line about it.
class LeftOut {
 public:
  /// A defect. @param text what it is; the first one's is told.
  void begin(const std::string& text);
  /// Bytes of the uncompressed data, of the file: that belong to no good object.
  void add(std::uint64_t bytes) { bytes_ += bytes; }
  void add_packed(std::uint64_t bytes) { packed_bytes_ += bytes; }
  /// A good object behind it.
  void goes_on(Stamp stamp);

  /// None: there was no defect.
  [[nodiscard]] std::optional<std::string> text() const;

 private:
  std::optional<std::string> first_;
  bool is_open_ = false;
  std::uint64_t bytes_before_ = 0;  ///< of all that was left out before the gap that is open
  std::size_t num_gaps_ = 0;        ///< that something good comes behind
  std::optional<Stamp> last_from_;
  std::uint64_t bytes_ = 0, packed_bytes_ = 0;
};

}  // namespace lidar_upsampling
