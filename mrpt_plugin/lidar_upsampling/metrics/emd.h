// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What it costs to move one cloud onto another of as many points, per point.
struct EarthMoverDistance {
  double squared_m2 = 0;  ///< mean squared distance of what is matched
  double plain_m = 0;     ///< mean distance of the same match
};

/// Most points that exact_emd() takes.
inline constexpr std::size_t kMaxExactEmdPoints = 2048;

/// @brief The literature's EMD: the soft match of Fan, Su, Guibas (A Point Set Generation Network,
/// CVPR 2017) at ten temperatures, -4^7 to -4^-1 and 0, in float; `squared_m2` is the figure that
/// PointINet, MoNet and NeuralPCI print. It is an approximation: not symmetric, no bijection, and
/// what is left beyond some 18 m is spread evenly. In parallel; the same for any number of threads.
/// @throw std::invalid_argument clouds of different sizes, or empty.
[[nodiscard]] EarthMoverDistance approximate_emd(const std::vector<Eigen::Vector3f>& first,
                                                 const std::vector<Eigen::Vector3f>& second);

/// @brief The one-to-one match of least total squared distance, found exactly.
/// @throw std::invalid_argument clouds of different sizes, empty, or above kMaxExactEmdPoints.
[[nodiscard]] EarthMoverDistance exact_emd(const std::vector<Eigen::Vector3f>& first,
                                           const std::vector<Eigen::Vector3f>& second);

}  // namespace lidar_upsampling
