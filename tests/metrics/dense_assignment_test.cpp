// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/dense_assignment.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lidar_upsampling
