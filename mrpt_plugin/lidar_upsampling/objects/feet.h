// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace lidar_upsampling {

/// @brief Which points something stands straight upon: where no ring meets the ground beside a car,
/// its lowest points are its own.
/// @param points in a frame with z up, whose origin lies below the sensor.
/// @param low, high m, of z: what lies outside is no ground.
/// @param gap_m where neighbouring rings are no farther apart, nothing is asked, as some ring does
/// meet it.
/// @return of each point, 1 or 0.
[[nodiscard]] std::vector<std::uint8_t> find_feet(const std::vector<Eigen::Vector3f>& points,
                                                  float low, float high, double vertical_step_deg,
                                                  double gap_m);

}  // namespace lidar_upsampling
