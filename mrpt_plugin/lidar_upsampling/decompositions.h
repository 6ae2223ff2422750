// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>

/// Eigen's decompositions of small matrices, compiled once: where each file has its own, they are a
/// third of what compilers work on.
namespace lidar_upsampling {

/// @brief x of A x = b, by LDL^T.
/// @param A symmetric, semidefinite.
template <int n, int m>
[[nodiscard]] Eigen::Matrix<double, n, m> solved(const Eigen::Matrix<double, n, n>& A,
                                                 const Eigen::Matrix<double, n, m>& b);

/// @brief An X of A X = B, for A of any rank.
/// @param A symmetric, semidefinite. @param B with columns in the range of A.
[[nodiscard]] Eigen::Matrix<double, 6, 6> solved_in_range(const Eigen::Matrix<double, 6, 6>& A,
                                                          const Eigen::Matrix<double, 6, 6>& B);

template <int n>
struct SymmetricEigen {
  Eigen::Matrix<double, n, 1> values;  ///< ascending
  Eigen::Matrix<double, n, n> vectors;
};

template <int n>
[[nodiscard]] SymmetricEigen<n> symmetric_eigen(const Eigen::Matrix<double, n, n>& A);

[[nodiscard]] Eigen::Matrix<double, 6, 6> inverse(const Eigen::Matrix<double, 6, 6>& A);
[[nodiscard]] double determinant(const Eigen::Matrix<double, 6, 6>& A);

}  // namespace lidar_upsampling
