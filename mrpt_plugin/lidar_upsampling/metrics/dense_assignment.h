// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
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
/// each (objects/assignment.h serves few objects, and pairs that must not be): shortest augmenting
/// paths after column and row reductions, as Jonker and Volgenant, Computing 38 (1987).
/// @throw std::invalid_argument not square, or a cost that is not finite.
[[nodiscard]] DenseAssignment solve_dense_assignment(const CostMatrix& cost);

}  // namespace lidar_upsampling
