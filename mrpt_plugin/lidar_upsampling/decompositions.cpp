// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace lidar_upsampling {

template <int n, int m>
Eigen::Matrix<double, n, m> solved(const Eigen::Matrix<double, n, n>& A,
                                   const Eigen::Matrix<double, n, m>& b) {
  return A.ldlt().solve(b);
}

Eigen::Matrix<double, 6, 6> least_norm_solved(const Eigen::Matrix<double, 6, 6>& A,
                                              const Eigen::Matrix<double, 6, 6>& B) {
  return A.completeOrthogonalDecomposition().solve(B);
}

template <int n>
SymmetricEigen<n> symmetric_eigen(const Eigen::Matrix<double, n, n>& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
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
