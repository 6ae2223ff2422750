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
/// closer to what is written, and stays as written in the end. Who stands for good and stands, and
/// only what parks or waits in the street of its own accord makes way (Scenario::cleared_s).
[[nodiscard]] Scenario drawn(const Scenario& written, std::uint32_t seed);

}  // namespace lidar_upsampling::sim
