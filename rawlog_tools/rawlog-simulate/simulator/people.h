// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// Their clothes have the seed's colours.
[[nodiscard]] Object make_pedestrian(std::uint32_t seed);
/// A bicycle and who rides it, 1.8 x 0.6 x 1.75 m: one rigid thing, whose wheels do not turn.
[[nodiscard]] Object make_cyclist(std::uint32_t seed);

}  // namespace lidar_upsampling::sim
