// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Exactly `count` points of a cloud, as the literature cuts clouds to size
/// (np.random.choice): drawn without replacement; of too small a cloud every point once, then as
/// many random repeats as are missing. The same on every machine.
/// @return in random order; repeats last.
/// @throw std::invalid_argument there are no points to draw from.
[[nodiscard]] std::vector<Eigen::Vector3f> sample_points(const std::vector<Eigen::Vector3f>& points,
                                                         std::size_t count, std::uint64_t seed);

}  // namespace lidar_upsampling
