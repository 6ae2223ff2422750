// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::fuzz {

/// A vehicle at rest between walls, and a box 7 m ahead that moves to the left: at instants of
/// images, 30 in a second.
constexpr int kColumns = 60, kRings = 16;
constexpr double kHeightOfSensors = 1.6;  // m

[[nodiscard]] Stamp stamp_at(int instant);
/// What a beam measures, m.
[[nodiscard]] double range_of(double azimuth, double elevation, int instant);
[[nodiscard]] LidarScan scan_at(int instant);
[[nodiscard]] CameraImage picture_at(int instant);

}  // namespace lidar_upsampling::fuzz
