// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// A scan whose points know what they lie on.
struct SimulatedScan {
  LidarScan scan;           ///< as it was measured: of a sweep, from where the lidar was by then
  std::vector<int> object;  ///< of each point, its place in World::objects
};

/// @brief What the LiDAR measures at an instant: the first hit of each beam, with Gaussian noise on
/// the range and random drop-outs. Surfaces that are dark, seen at a glancing angle or of glass
/// return from shorter ranges, or not at all. The random numbers depend on seed, stamp and beam
/// only: the same instant gives the same bytes, whichever log it is for, on any number of threads.
[[nodiscard]] SimulatedScan scan_at(const World& world, const LidarSpec& lidar, Stamp stamp,
                                    std::uint32_t seed);

/// @brief When a column is measured, in seconds from the stamp: 0 unless the lidar sweeps, when the
/// stamp is the instant at which it faces forward.
[[nodiscard]] double sweep_time(const LidarSpec& lidar, int column);

/// Of a beam in the lidar frame, unit length. Columns run clockwise from the rear, as the scanner
/// turns, or from left to right in a depth picture.
[[nodiscard]] Eigen::Vector3d beam_direction(const LidarSpec& lidar, int ring, int column);

}  // namespace lidar_upsampling::sim
