// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace lidar_upsampling {
namespace {

CostMatrix random_cost(int size, unsigned seed, bool whole_numbers) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-5, 10);
  return CostMatrix::NullaryExpr(
      size, size, [&] { return whole_numbers ? std::round(any(random)) : any(random); });
}

/// By weak duality no assignment is cheaper than one that meets feasible potentials.
void expect_proven_optimal(const CostMatrix& cost, const DenseAssignment& found) {
  const auto& columns = found.column_of_row;
  ASSERT_EQ(columns.size(), static_cast<std::size_t>(cost.rows()));
  EXPECT_EQ(std::set<int>(columns.begin(), columns.end()).size(), columns.size());
  const CostMatrix slack =
      (cost.colwise() - found.row_potential).rowwise() - found.column_potential.transpose();
  EXPECT_GT(slack.minCoeff(), -1e-9);
  for (int row = 0; row < cost.rows(); ++row) {
    EXPECT_NEAR(slack(row, columns[row]), 0, 1e-9);
  }
}

TEST(DenseAssignment, proves_that_none_is_cheaper) {
  for (const int size : {1, 2, 3, 10, 60, 400}) {
    for (const bool whole_numbers : {false, true}) {
      const CostMatrix cost = random_cost(size, 1, whole_numbers);
      expect_proven_optimal(cost, solve_dense_assignment(cost));
    }
  }
}

TEST(DenseAssignment, copes_with_costs_all_alike_and_all_quarrelling) {
  expect_proven_optimal(CostMatrix::Zero(50, 50), solve_dense_assignment(CostMatrix::Zero(50, 50)));
  // Every row wants the same columns in the same order: cost = row * column.
  CostMatrix cost(80, 80);
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 80; ++column) {
      cost(row, column) = row * column;
    }
  }
  const auto found = solve_dense_assignment(cost);
  expect_proven_optimal(cost, found);
  EXPECT_EQ(found.column_of_row.front(), 79);
  EXPECT_EQ(found.column_of_row.back(), 0);
}

TEST(DenseAssignment, of_nothing_is_nothing) {
  EXPECT_TRUE(solve_dense_assignment(CostMatrix(0, 0)).column_of_row.empty());
}

TEST(DenseAssignment, refuses_what_is_not_square_or_not_finite) {
  EXPECT_THROW(static_cast<void>(solve_dense_assignment(CostMatrix::Zero(2, 3))),
               std::invalid_argument);
  CostMatrix cost = CostMatrix::Zero(3, 3);
  cost(1, 2) = std::nan("");
  EXPECT_THROW(static_cast<void>(solve_dense_assignment(cost)), std::invalid_argument);
}

double total(const Eigen::MatrixXd& cost, const std::vector<int>& column_of_row, double max_cost) {
  double sum = 0;
  for (std::size_t row = 0; row < column_of_row.size(); ++row) {
    const int column = column_of_row[row];
    sum += column < 0 ? max_cost : cost(static_cast<Eigen::Index>(row), column);
  }
  return sum;
}

/// Tries every column, or none, for each row.
double least_total(const Eigen::MatrixXd& cost, Eigen::Index row, std::vector<bool>& taken,
                   double max_cost) {
  if (row == cost.rows()) return 0;
  double best = max_cost + least_total(cost, row + 1, taken, max_cost);
  for (Eigen::Index column = 0; column < cost.cols(); ++column) {
    if (taken[column] || cost(row, column) >= max_cost) continue;
    taken[column] = true;
    best = std::min(best, cost(row, column) + least_total(cost, row + 1, taken, max_cost));
    taken[column] = false;
  }
  return best;
}

TEST(Assignment, costs_as_little_as_trying_everything) {
  std::mt19937 generator(11);
  std::uniform_int_distribution<int> size(1, 6);
  std::uniform_real_distribution<double> value(-1, 10);
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::MatrixXd cost(size(generator), size(generator));
    for (double& entry : cost.reshaped()) entry = value(generator);
    const double max_cost = trial % 3 == 0 ? 100 : 6;
    const std::vector<int> found = solve_assignment(cost, max_cost);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(cost.rows()));
    std::vector<bool> taken(cost.cols(), false);
    for (std::size_t row = 0; row < found.size(); ++row) {
      if (found[row] < 0) continue;
      EXPECT_LT(cost(static_cast<Eigen::Index>(row), found[row]), max_cost);
      EXPECT_FALSE(taken[found[row]]);
      taken[found[row]] = true;
    }
    std::fill(taken.begin(), taken.end(), false);
    EXPECT_NEAR(total(cost, found, max_cost), least_total(cost, 0, taken, max_cost), 1e-9);
  }
}

TEST(Assignment, every_row_has_a_column_where_nothing_is_forbidden) {
  Eigen::MatrixXd cost(2, 3);
  cost << 5, 1, 9, 2, 1, 9;
  EXPECT_EQ(solve_assignment(cost), (std::vector<int>{1, 0}));
}

TEST(Assignment, a_matrix_without_columns_leaves_all_rows_alone) {
  EXPECT_EQ(solve_assignment(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
  EXPECT_TRUE(solve_assignment(Eigen::MatrixXd(0, 3)).empty());
}

TEST(Assignment, a_cost_that_is_no_number_is_refused) {
  EXPECT_THROW(static_cast<void>(solve_assignment(Eigen::MatrixXd::Constant(1, 1, NAN))),
               std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
