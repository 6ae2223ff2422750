// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/assignment.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kNone = -1;

using Costs = Eigen::Array<double, 1, Eigen::Dynamic>;

class Solver {
 public:
  explicit Solver(const CostMatrix& cost)
      : cost_(cost),
        size_(static_cast<int>(cost.rows())),
        column_potential_(cost.colwise().minCoeff()),
        column_of_row_(size_, kNone),
        row_of_column_(size_, kNone) {}

  DenseAssignment solve() {
    for (int row = 0; row < size_; ++row) augment(row);
    DenseAssignment result{column_of_row_, Eigen::VectorXd(size_),
                           column_potential_.matrix().transpose()};
    for (int row = 0; row < size_; ++row) {
      result.row_potential[row] = reduced(row, column_of_row_[row]);
    }
    return result;
  }

 private:
  [[nodiscard]] double reduced(int row, int column) const {
    return cost_(row, column) - column_potential_[column];
  }

  /// A column that Dijkstra has reached for good, and how far the row that holds it starts.
  struct Reached {
    int column, row;
    double distance, offset;
  };

  /// Dijkstra over reduced costs from a free row to the nearest free column, then shifts the pairs
  /// along the path to it. Reached columns are hidden by an infinite price, so that what is left
  /// of a step is arithmetic on whole rows.
  void augment(int root) {
    std::vector<Reached> reached{{kNone, root, 0, 0}};
    Costs price = column_potential_;
    Costs distance = Costs::Constant(size_, kInfinity);
    while (true) {
      const Reached& last = reached.back();
      distance = distance.min(cost_.row(last.row).array() - price + last.offset);
      const double least = distance.minCoeff();
      const int nearest = static_cast<int>(
          std::find(distance.data(), distance.data() + size_, least) - distance.data());
      const int row = row_of_column_[nearest];
      if (row == kNone) {
        for (std::size_t i = 1; i < reached.size(); ++i) {
          column_potential_[reached[i].column] += reached[i].distance - least;
        }
        return shift_pairs(nearest, reached);
      }
      reached.push_back({nearest, row, least, least - reduced(row, nearest)});
      distance[nearest] = kInfinity;
      price[nearest] = -kInfinity;
    }
  }

  /// Follows the shortest path back: each column was reached by the row that makes it nearest, one
  /// of those reached before it.
  void shift_pairs(int column, const std::vector<Reached>& reached) {
    for (std::size_t end = reached.size(); end > 0;) {
      std::size_t before = 0;
      for (std::size_t i = 1; i < end; ++i) {
        before = reached[i].offset + cost_(reached[i].row, column) <
                         reached[before].offset + cost_(reached[before].row, column)
                     ? i
                     : before;
      }
      pair(reached[before].row, column);
      column = reached[before].column;
      end = before;
    }
  }

  void pair(int row, int column) {
    column_of_row_[row] = column;
    row_of_column_[column] = row;
  }

  const CostMatrix& cost_;
  int size_;
  Costs column_potential_;
  std::vector<int> column_of_row_, row_of_column_;
};

}  // namespace

DenseAssignment solve_dense_assignment(const CostMatrix& cost) {
  if (cost.rows() != cost.cols() || !cost.allFinite()) {
    throw std::invalid_argument("solve_dense_assignment: " + std::to_string(cost.rows()) +
                                " rows, " + std::to_string(cost.cols()) +
                                " columns; must be square and of finite costs");
  }
  return cost.size() == 0 ? DenseAssignment{} : Solver(cost).solve();
}

std::vector<int> solve_assignment(const Eigen::MatrixXd& cost, double max_cost) {
  // Whom the square's other rows or columns go to changes no total; capped, a forbidden pair costs
  // what leaving its row alone costs.
  const Eigen::Index size = std::max(cost.rows(), cost.cols());
  CostMatrix square = CostMatrix::Zero(size, size);
  square.topLeftCorner(cost.rows(), cost.cols()) =
      cost.unaryExpr([&](double value) { return value > max_cost ? max_cost : value; });
  std::vector<int> column_of_row = solve_dense_assignment(square).column_of_row;
  column_of_row.resize(static_cast<std::size_t>(cost.rows()));
  for (Eigen::Index row = 0; row < cost.rows(); ++row) {
    int& column = column_of_row[row];
    if (column >= cost.cols() || cost(row, column) >= max_cost) column = kNone;
  }
  return column_of_row;
}

}  // namespace lidar_upsampling
