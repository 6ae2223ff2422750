// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace lidar_upsampling {

/// Row after row in memory, as the solver reads it.
using CostMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A one-to-one assignment, and the proof that none is cheaper: no cost lies below the sum of its
/// row's and its column's potential, and those of the chosen pairs are equal to it.
struct DenseAssignment {
  std::vector<int> column_of_row;
  Eigen::VectorXd row_potential, column_potential;
};

/// @brief The assignment of every row to a column of its own at least total cost, for thousands of
/// each: shortest augmenting paths after a column reduction, as Jonker and Volgenant, Computing 38
/// (1987), but without their bidding, which on distances of points gained nothing.
/// @throw std::invalid_argument not square, or a cost that is not finite.
[[nodiscard]] DenseAssignment solve_dense_assignment(const CostMatrix& cost);

/// @brief The assignment of rows to columns of least total cost, where a row left without a column
/// costs `max_cost`.
/// @param cost any shape, without NaN; pairs at or above `max_cost` are never made.
/// @return the column of each row, -1 for none.
/// @throw std::invalid_argument a NaN or -inf cost, or an infinite one with an infinite `max_cost`.
[[nodiscard]] std::vector<int> solve_assignment(
    const Eigen::MatrixXd& cost, double max_cost = std::numeric_limits<double>::infinity());

}  // namespace lidar_upsampling
