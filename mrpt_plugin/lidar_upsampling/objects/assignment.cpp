// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/assignment.h"

#include <stdexcept>
#include <string>

namespace lidar_upsampling {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kNone = -1;

/// Rows <= columns, finite costs. Column `cost.cols()` is the root that the row being placed hangs
/// on.
class Hungarian {
 public:
  explicit Hungarian(const Eigen::MatrixXd& cost)
      : cost_(cost),
        root_(static_cast<int>(cost.cols())),
        row_potential_(static_cast<std::size_t>(cost.rows()), 0.),
        column_potential_(static_cast<std::size_t>(cost.cols()) + 1, 0.),
        row_of_column_(static_cast<std::size_t>(cost.cols()) + 1, kNone) {}

  std::vector<int> solve() {
    for (int row = 0; row < cost_.rows(); ++row) place(row);
    std::vector<int> column_of_row(row_potential_.size(), kNone);
    for (int column = 0; column < root_; ++column) {
      if (row_of_column_[column] != kNone) column_of_row[row_of_column_[column]] = column;
    }
    return column_of_row;
  }

 private:
  /// Dijkstra over reduced costs to the nearest free column, then flips the path to it.
  void place(int row) {
    row_of_column_[root_] = row;
    std::vector<double> distance(column_potential_.size(), kInfinity);
    std::vector<int> previous(column_potential_.size(), root_);
    std::vector<bool> done(column_potential_.size(), false);
    int column = root_;
    while (row_of_column_[column] != kNone) {
      done[column] = true;
      column = grow(column, done, distance, previous);
    }
    for (; column != root_; column = previous[column]) {
      row_of_column_[column] = row_of_column_[previous[column]];
    }
  }

  int grow(int from, const std::vector<bool>& done, std::vector<double>& distance,
           std::vector<int>& previous) {
    const int row = row_of_column_[from];
    int nearest = kNone;
    for (int column = 0; column < root_; ++column) {
      if (done[column]) continue;
      const double reduced = cost_(row, column) - row_potential_[row] - column_potential_[column];
      if (reduced < distance[column]) {
        distance[column] = reduced;
        previous[column] = from;
      }
      if (nearest == kNone || distance[column] < distance[nearest]) nearest = column;
    }
    const double step = distance[nearest];
    for (int column = 0; column <= root_; ++column) {
      if (done[column]) {
        row_potential_[row_of_column_[column]] += step;
        column_potential_[column] -= step;
      } else {
        distance[column] -= step;
      }
    }
    return nearest;
  }

  const Eigen::MatrixXd& cost_;
  int root_;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  std::vector<int> row_of_column_;
};

void check(const Eigen::MatrixXd& cost, double max_cost) {
  for (Eigen::Index i = 0; i < cost.size(); ++i) {
    const double value = cost.data()[i];
    if (value != value || value == -kInfinity || (value == kInfinity && max_cost == kInfinity)) {
      throw std::invalid_argument("solve_assignment: cost " + std::to_string(value) + " in row " +
                                  std::to_string(i % cost.rows()) + ", column " +
                                  std::to_string(i / cost.rows()));
    }
  }
}

}  // namespace

std::vector<int> solve_assignment(const Eigen::MatrixXd& cost, double max_cost) {
  check(cost, max_cost);
  std::vector<int> column_of_row(static_cast<std::size_t>(cost.rows()), kNone);
  if (cost.size() == 0) return column_of_row;

  // Capped, a forbidden pair costs what leaving the row alone costs.
  const Eigen::MatrixXd capped = cost.cwiseMin(max_cost);
  if (cost.rows() <= cost.cols()) {
    column_of_row = Hungarian(capped).solve();
  } else {
    const Eigen::MatrixXd transposed = capped.transpose();
    const std::vector<int> row_of_column = Hungarian(transposed).solve();
    for (std::size_t column = 0; column < row_of_column.size(); ++column) {
      column_of_row[row_of_column[column]] = static_cast<int>(column);
    }
  }
  for (Eigen::Index row = 0; row < cost.rows(); ++row) {
    int& column = column_of_row[row];
    if (column != kNone && cost(row, column) >= max_cost) column = kNone;
  }
  return column_of_row;
}

}  // namespace lidar_upsampling
