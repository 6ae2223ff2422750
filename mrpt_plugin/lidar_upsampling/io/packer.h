// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Packs blocks as gzip members (RFC 1952), each of which stands alone: one after the other
/// they are a gzip file.
class Packer {
 public:
  virtual ~Packer() = default;
  /// @return the packed block, valid until the next call. @throw std::runtime_error it cannot be.
  [[nodiscard]] virtual const std::vector<std::uint8_t>& pack(
      const std::vector<std::uint8_t>& block) = 0;
};

/// @param compression none: blocks stay as they are; fast: ISA-L, the same bytes on processors
/// alike; small: libdeflate.
[[nodiscard]] std::unique_ptr<Packer> make_packer(Compression compression);

}  // namespace lidar_upsampling
