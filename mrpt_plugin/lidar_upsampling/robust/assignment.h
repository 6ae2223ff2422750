// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace lidar_upsampling {

/// Row after row in memory, as the solver reads it.
using CostMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// @brief The assignment of rows to columns of least total cost, where a row left without a column
/// costs `max_cost`; for thousands of each: shortest augmenting paths after a column reduction, as
/// Jonker and Volgenant, Computing 38 (1987), but without their bidding, which on distances of
/// points gained nothing.
/// @param cost any shape, without NaN; pairs at or above `max_cost` are never made.
/// @return the column of each row, -1 for none.
/// @throw std::invalid_argument a NaN or -inf cost, or an infinite one with an infinite `max_cost`.
[[nodiscard]] std::vector<int> solve_assignment(
    const CostMatrix& cost, double max_cost = std::numeric_limits<double>::infinity());

}  // namespace lidar_upsampling
