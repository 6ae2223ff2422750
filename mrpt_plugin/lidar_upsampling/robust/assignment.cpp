// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/assignment.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace lidar_upsampling {

namespace {

constexpr int kNone = -1;

using Costs = Eigen::Array<double, 1, Eigen::Dynamic>;

/// Of a square matrix, which row gets each column.
class Solver {
 public:
  explicit Solver(const CostMatrix& cost)
      : cost_(cost),
        column_potential_(cost.colwise().minCoeff()),
        row_of_column_(static_cast<std::size_t>(cost.cols()), kNone) {}

  const std::vector<int>& solve() {
    for (int row = 0; row < cost_.rows(); ++row) augment(row);
    return row_of_column_;
  }

 private:
  /// A column that Dijkstra has reached for good, and how far the row that holds it starts.
  struct Reached {
    int column, row;
    double distance, offset;
  };

  /// Dijkstra over reduced costs from a free row to the nearest free column, then shifts the pairs
  /// along the path to it. Reached columns are hidden by an infinite price, so that what is left
  /// of a step is arithmetic on whole rows.
  void augment(int root) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<Reached> reached{{kNone, root, 0, 0}};
    Costs price = column_potential_;
    Costs distance = Costs::Constant(cost_.cols(), kInfinity);
    while (true) {
      const Reached& last = reached.back();
      distance = distance.min(cost_.row(last.row).array() - price + last.offset);
      const double least = distance.minCoeff();
      const int nearest = static_cast<int>(
          std::find(distance.data(), distance.data() + distance.size(), least) - distance.data());
      const int row = row_of_column_[nearest];
      if (row == kNone) {
        for (std::size_t i = 1; i < reached.size(); ++i) {
          column_potential_[reached[i].column] += reached[i].distance - least;
        }
        return shift_pairs(nearest, reached);
      }
      reached.push_back(
          {nearest, row, least, least - (cost_(row, nearest) - column_potential_[nearest])});
      distance[nearest] = kInfinity;
      price[nearest] = -kInfinity;
    }
  }

  /// Follows the shortest path back: each column was reached by the row that makes it nearest, one
  /// of those reached before it.
  void shift_pairs(int column, const std::vector<Reached>& reached) {
    const auto distance_by = [&](const Reached& by) { return by.offset + cost_(by.row, column); };
    for (auto end = reached.end(); end != reached.begin();) {
      end = std::min_element(reached.begin(), end, [&](const Reached& a, const Reached& b) {
        return distance_by(a) < distance_by(b);
      });
      row_of_column_[column] = end->row;
      column = end->column;
    }
  }

  const CostMatrix& cost_;
  Costs column_potential_;
  std::vector<int> row_of_column_;
};

}  // namespace

std::vector<int> solve_assignment(const CostMatrix& cost, double max_cost) {
  // Whom the square's other rows or columns go to changes no total; capped, a forbidden pair costs
  // what leaving its row alone costs.
  const Eigen::Index size = std::max(cost.rows(), cost.cols());
  CostMatrix square = CostMatrix::Zero(size, size);
  square.topLeftCorner(cost.rows(), cost.cols()) =
      cost.unaryExpr([&](double value) { return value > max_cost ? max_cost : value; });
  if (!square.allFinite()) throw std::invalid_argument("assignment: a cost is not finite");
  std::vector<int> column_of_row(static_cast<std::size_t>(cost.rows()), kNone);
  if (size == 0) return column_of_row;
  const std::vector<int> row_of_column = Solver(square).solve();
  for (int column = 0; column < cost.cols(); ++column) {
    const int row = row_of_column[column];
    if (row < cost.rows() && cost(row, column) < max_cost) column_of_row[row] = column;
  }
  return column_of_row;
}

}  // namespace lidar_upsampling
