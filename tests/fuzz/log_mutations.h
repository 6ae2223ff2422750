// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "fuzz/byte_mutations.h"
#include "fuzz/log_seeds.h"

namespace lidar_upsampling::fuzz {

/// The log as it is, in one gzip member.
[[nodiscard]] Bytes whole_log(const LogSeed& seed);

/// @brief The log as a file that something is wrong with: fields of observations, their order,
/// their bytes, or those of the file, packed or not.
[[nodiscard]] Bytes damaged_log(const LogSeed& seed, Random& random);

}  // namespace lidar_upsampling::fuzz
