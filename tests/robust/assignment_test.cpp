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

double total(const CostMatrix& cost, const std::vector<int>& column_of_row, double max_cost) {
  double sum = 0;
  for (std::size_t row = 0; row < column_of_row.size(); ++row) {
    const int column = column_of_row[row];
    sum += column < 0 ? max_cost : cost(static_cast<Eigen::Index>(row), column);
  }
  return sum;
}

/// Tries every column, or none, for each row.
double least_total(const CostMatrix& cost, Eigen::Index row, std::vector<bool>& taken,
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
    CostMatrix cost(size(generator), size(generator));
    for (double& entry : cost.reshaped<Eigen::RowMajor>()) entry = value(generator);
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

TEST(Assignment, copes_with_costs_all_alike_and_all_quarrelling) {
  const std::vector<int> any = solve_assignment(CostMatrix::Zero(50, 50));
  EXPECT_EQ(std::set<int>(any.begin(), any.end()).size(), 50U);
  // Every row wants the same columns in the same order: cost = row * column.
  const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(80, 0, 79);
  const auto found = solve_assignment(numbers * numbers.transpose());
  EXPECT_EQ(found.front(), 79);
  EXPECT_EQ(found.back(), 0);
}

TEST(Assignment, every_row_has_a_column_where_nothing_is_forbidden) {
  CostMatrix cost(2, 3);
  cost << 5, 1, 9, 2, 1, 9;
  EXPECT_EQ(solve_assignment(cost), (std::vector<int>{1, 0}));
}

TEST(Assignment, a_matrix_without_columns_leaves_all_rows_alone) {
  EXPECT_EQ(solve_assignment(CostMatrix(2, 0)), (std::vector<int>{-1, -1}));
  EXPECT_TRUE(solve_assignment(CostMatrix(0, 3)).empty());
}

TEST(Assignment, a_cost_that_is_no_number_is_refused) {
  EXPECT_THROW(static_cast<void>(solve_assignment(CostMatrix::Constant(1, 1, NAN))),
               std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
