// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "argoverse2rawlog/argoverse_calibration.h"

namespace lidar_upsampling::argoverse {

constexpr int kLasersPerLidar = 32;
constexpr int kRings = 2 * kLasersPerLidar;

/// Elevation of a laser in its own LiDAR's frame, radians: laser 0 is the highest (VLP-32C User
/// Manual, table 9-6, in descending order).
[[nodiscard]] double laser_elevation(int laser);

/// @brief Which of the 64 rings each point was measured by, 0 the lowest. The sweeps hold the
/// points of two LiDARs and number the lasers of both from 0 to 31; which one a point comes from
/// shows in its elevation, which fits its laser's in only one of the two, and in the order: all
/// points of one, then all of the other.
/// @param points in the vehicle frame.
/// @return empty where lasers and points do not agree with that: another numbering, or another
/// calibration.
[[nodiscard]] std::vector<std::uint16_t> rings_of(const std::vector<Eigen::Vector3d>& points,
                                                  const std::vector<int>& lasers,
                                                  const Calibration& calibration);

}  // namespace lidar_upsampling::argoverse
