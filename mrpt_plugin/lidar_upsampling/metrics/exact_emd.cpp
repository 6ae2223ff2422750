// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/metrics/emd.h"
#include "lidar_upsampling/robust/assignment.h"

namespace lidar_upsampling {

namespace {

/// A shift adds the same to the squared costs of every one-to-one match: without it the best one is
/// the same, and found many times sooner.
Eigen::Matrix3Xd centred(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Matrix3Xd result(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.col(static_cast<Eigen::Index>(i)) = points[i].cast<double>();
  }
  return result.colwise() - result.rowwise().mean();
}

}  // namespace

EarthMoverDistance exact_emd(const std::vector<Eigen::Vector3f>& first,
                             const std::vector<Eigen::Vector3f>& second) {
  if (first.size() != second.size() || first.empty() || first.size() > kMaxExactEmdPoints) {
    throw std::invalid_argument("exact EMD of " + std::to_string(first.size()) + " and " +
                                std::to_string(second.size()) +
                                " points: the clouds must be of one size, at most " +
                                std::to_string(kMaxExactEmdPoints) + "; see sample_points()");
  }
  const auto count = static_cast<Eigen::Index>(first.size());
  const Eigen::Matrix3Xd from = centred(first), to = centred(second);
  CostMatrix cost(count, count);
  for (Eigen::Index row = 0; row < count; ++row) {
    cost.row(row) = (to.colwise() - from.col(row)).colwise().squaredNorm();
  }
  const DenseAssignment match = solve_dense_assignment(cost);
  EarthMoverDistance sum;
  for (Eigen::Index row = 0; row < count; ++row) {
    const auto column = static_cast<std::size_t>(match.column_of_row[row]);
    const double squared =
        (first[row].cast<double>() - second[column].cast<double>()).squaredNorm();
    sum.squared_m2 += squared;
    sum.plain_m += std::sqrt(squared);
  }
  return {sum.squared_m2 / static_cast<double>(count), sum.plain_m / static_cast<double>(count)};
}

}  // namespace lidar_upsampling
