// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include "fuzz/random.h"

namespace lidar_upsampling::fuzz {

/// Whether lists may become longer or shorter than those beside them, which MRPT cannot write.
enum class Sizes { kept, changed };

/// @brief Gives a field of an observation, or of one in a frame, a value that it should not have:
/// numbers that are none, sizes that do not fit together, stamps and labels of others.
void spoil(mrpt::serialization::CSerializable& object, Random& random, Sizes sizes);

}  // namespace lidar_upsampling::fuzz
