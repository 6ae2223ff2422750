// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/random.h"

namespace lidar_upsampling::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// @brief Damages bytes as disks, cut transfers and wrong writers do: bits flipped, sectors zeroed,
/// cut off, sizes and numbers that cannot be, pieces that are missing or twice.
void damage(Bytes& bytes, Random& random);

/// The same for text, and besides: numbers, cells and lines of another kind than expected.
[[nodiscard]] std::string damaged_text(const std::string& text, Random& random);

}  // namespace lidar_upsampling::fuzz
