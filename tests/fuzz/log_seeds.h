// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <string>
#include <vector>

namespace lidar_upsampling::fuzz {

/// The objects of a good log.
using LogObjects = std::vector<mrpt::serialization::CSerializable::Ptr>;

struct LogSeed {
  std::string name;
  LogObjects objects;
};

/// @brief Logs of less than a quarter of a second, one per carrier and way to store them: a vehicle
/// at rest in a yard, a box that moves, scans at 10 Hz and images at 30 Hz.
[[nodiscard]] const std::vector<LogSeed>& log_seeds();

}  // namespace lidar_upsampling::fuzz
