// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/scenario.h"

namespace lidar_upsampling::sim {

/// @brief Another situation of the same kind: who is there, and on which way, stays as written; how
/// fast, exactly where, in which colour and light, how noisily seen and beside which street is
/// drawn within the scenario's `variation`. The same seed draws the same.
///
/// Nobody touches another or the ego before the scenario's end: what would is drawn again, ever
/// closer to what is written, and stays as written in the end. Vehicles that stand stay standing,
/// and what of the street's own is in somebody's way is left out (Scenario::cleared_s).
[[nodiscard]] Scenario drawn(const Scenario& written, std::uint32_t seed);

}  // namespace lidar_upsampling::sim
