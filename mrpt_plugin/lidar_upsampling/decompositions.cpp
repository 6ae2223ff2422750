// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>

namespace lidar_upsampling {

template <int n, int m>
Eigen::Matrix<double, n, m> solved(const Eigen::Matrix<double, n, n>& A,
                                   const Eigen::Matrix<double, n, m>& b) {
  return A.ldlt().solve(b);
}

template <int n>
SymmetricEigen<n> symmetric_eigen(const Eigen::Matrix<double, n, n>& A) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver;
  if constexpr (n == 2)
    solver.computeDirect(A);  // the closed form, which compiles in a tenth of the time
  else
    solver.compute(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Matrix<double, 6, 6> solved_in_range(const Eigen::Matrix<double, 6, 6>& A,
                                            const Eigen::Matrix<double, 6, 6>& B) {
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  // In units in which the diagonal is 1: radians and metres differ by orders of magnitude.
  const auto inverse_or_0 = [](double value) { return value > 0 ? 1 / value : 0; };
  const Vector6d unit = A.diagonal().unaryExpr(inverse_or_0).cwiseSqrt();
  const SymmetricEigen<6> eigen = symmetric_eigen<6>(unit.asDiagonal() * A * unit.asDiagonal());
  const double none = 6 * std::numeric_limits<double>::epsilon() * eigen.values[5];
  const Vector6d inverse =
      eigen.values.unaryExpr([&](double value) { return value > none ? 1 / value : 0; });
  return unit.asDiagonal() * eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose() *
         unit.asDiagonal() * B;
}

Eigen::Matrix<double, 6, 6> inverse(const Eigen::Matrix<double, 6, 6>& A) { return A.inverse(); }

double determinant(const Eigen::Matrix<double, 6, 6>& A) { return A.determinant(); }

template Eigen::Matrix<double, 3, 1> solved(const Eigen::Matrix<double, 3, 3>&,
                                            const Eigen::Matrix<double, 3, 1>&);
template Eigen::Matrix<double, 3, 8> solved(const Eigen::Matrix<double, 3, 3>&,
                                            const Eigen::Matrix<double, 3, 8>&);
template Eigen::Matrix<double, 5, 8> solved(const Eigen::Matrix<double, 5, 5>&,
                                            const Eigen::Matrix<double, 5, 8>&);
template Eigen::Matrix<double, 6, 1> solved(const Eigen::Matrix<double, 6, 6>&,
                                            const Eigen::Matrix<double, 6, 1>&);
template Eigen::Matrix<double, 8, 8> solved(const Eigen::Matrix<double, 8, 8>&,
                                            const Eigen::Matrix<double, 8, 8>&);
template SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix<double, 2, 2>&);
template SymmetricEigen<6> symmetric_eigen(const Eigen::Matrix<double, 6, 6>&);

}  // namespace lidar_upsampling
