// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace lidar_upsampling {

/// @brief The assignment of rows to columns of least total cost, where a row left without a column
/// costs `max_cost`. Kuhn's Hungarian method with potentials, O(n^3) (Burkard, Dell'Amico,
/// Martello: Assignment Problems, 4.2).
/// @param cost any shape, without NaN; pairs at or above `max_cost` are never made.
/// @return the column of each row, -1 for none.
/// @throw std::invalid_argument a NaN or -inf cost, or an infinite one with an infinite `max_cost`.
[[nodiscard]] std::vector<int> solve_assignment(
    const Eigen::MatrixXd& cost, double max_cost = std::numeric_limits<double>::infinity());

}  // namespace lidar_upsampling
