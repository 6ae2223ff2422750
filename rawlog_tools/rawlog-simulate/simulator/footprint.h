// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// The ground that something covers on its way: a rectangle about its frame's origin.
struct Footprint {
  double length = 0, width = 0;  ///< m
  MotionProfile motion;
};

[[nodiscard]] Footprint footprint_of(const Object& object);
/// Of a car.
[[nodiscard]] Footprint ego_footprint(const EgoSpec& ego);

/// Whether two come within `gap_m` of each other (each side of one is moved out by it) in the first
/// `until_s` seconds, looked at every 50 ms.
[[nodiscard]] bool ever_touch(const Footprint& a, const Footprint& b, double until_s, double gap_m);

}  // namespace lidar_upsampling::sim
