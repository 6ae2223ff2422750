// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Packs blocks, which one after the other are a file: gzip members (RFC 1952), each of
/// which stands alone, or all of them one zstd frame (RFC 8878), as MRPT 2.15 may take the border
/// of two frames for the end of the file.
class Packer {
 public:
  virtual ~Packer() = default;
  /// Whether gzip members that others have packed may come between.
  [[nodiscard]] virtual bool takes_members() const { return false; }
  /// @return the packed block, valid until the next call. @throw std::runtime_error it cannot be.
  [[nodiscard]] virtual const std::vector<std::uint8_t>& pack(
      const std::vector<std::uint8_t>& block) = 0;
  /// @return what comes behind the last block. @throw std::runtime_error likewise.
  [[nodiscard]] virtual const std::vector<std::uint8_t>& finish() {
    static const std::vector<std::uint8_t> nothing;
    return nothing;
  }
};

/// @param compression none: blocks stay as they are; fast: ISA-L, the same bytes on processors
/// alike; gzip: libdeflate.
[[nodiscard]] std::unique_ptr<Packer> make_packer(Compression compression);

}  // namespace lidar_upsampling
