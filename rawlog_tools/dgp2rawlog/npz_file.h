// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <string>

namespace lidar_upsampling::dgp {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// @brief The table of numbers that is the first array of a .npz archive, as numpy.savez and
/// savez_compressed write it.
/// @throw std::runtime_error with the file: it cannot be read, is cut off or damaged, or holds
/// anything but rows of 32 or 64 bit floating point numbers.
[[nodiscard]] Rows read_npz(const std::string& path);

}  // namespace lidar_upsampling::dgp
