// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/p3p.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Squared sides between points and squared chords between bearings: 0-1, 0-2, 1-2. With s the
/// distances along the bearings, the law of cosines reads (s_i - s_j)^2 + s_i s_j sq_chord =
/// sq_side.
struct Triangle {
  std::array<double, 3> sq_side;
  std::array<double, 3> sq_chord;
};

/// The left sides of the three laws as quadratic forms of (s0 * unit, s1 - s0, s2 - s0).
std::array<Eigen::Matrix3d, 3> quadratic_forms(const Triangle& triangle, double unit) {
  const auto& [chord01, chord02, chord12] = triangle.sq_chord;
  const auto form = [unit](double sq_chord, const Eigen::Vector3d& difference,
                           const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
    const Eigen::Vector3d scale(1 / unit, 1, 1);
    const Eigen::Matrix3d product = first * second.transpose();
    const Eigen::Matrix3d m =
        difference * difference.transpose() + 0.5 * sq_chord * (product + product.transpose());
    return Eigen::Matrix3d(scale.asDiagonal() * m * scale.asDiagonal());
  };
  const Eigen::Vector3d s0(1, 0, 0);
  const Eigen::Vector3d s1(1, 1, 0);
  const Eigen::Vector3d s2(1, 0, 1);
  return {form(chord01, {0, 1, 0}, s0, s1), form(chord02, {0, 0, 1}, s0, s2),
          form(chord12, {0, 1, -1}, s1, s2)};
}

Eigen::Matrix3d adjugate(const Eigen::Matrix3d& symmetric) {
  Eigen::Matrix3d result;
  result.col(0) = symmetric.col(1).cross(symmetric.col(2));
  result.col(1) = symmetric.col(2).cross(symmetric.col(0));
  result.col(2) = symmetric.col(0).cross(symmetric.col(1));
  return result;
}

/// Real roots of x^3 + b x^2 + c x + d; multiple ones may be missing.
std::vector<double> cubic_roots(double b, double c, double d) {
  const double p = c / 3 - b * b / 9;
  const double q = b * b * b / 27 - b * c / 6 + d / 2;
  const double discriminant = q * q + p * p * p;
  std::vector<double> roots;
  if (discriminant > 0) {
    const double s = -std::copysign(std::cbrt(std::abs(q) + std::sqrt(discriminant)), q);
    roots.push_back((s == 0 ? 0 : s - p / s) - b / 3);
  } else {
    const double radius = std::sqrt(-p);
    const double angle = std::atan2(std::sqrt(-discriminant), -q) / 3;
    constexpr double kThirdOfTurn = 2 * kPi / 3;
    for (int i = 0; i < 3; ++i) {
      roots.push_back(2 * radius * std::cos(angle + i * kThirdOfTurn) - b / 3);
    }
  }
  for (double& root : roots) {
    for (int i = 0; i < 2; ++i) {
      const double slope = (3 * root + 2 * b) * root + c;
      if (slope != 0) root -= (((root + b) * root + c) * root + d) / slope;
    }
  }
  return roots;
}

/// A degenerate conic of the pencil a + g b that consists of two real lines.
std::optional<Eigen::Matrix3d> pair_of_lines(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d adjugate_a = adjugate(a);
  const Eigen::Matrix3d adjugate_b = adjugate(b);
  const double cubic = b.determinant();
  if (cubic == 0) return std::nullopt;
  std::optional<Eigen::Matrix3d> best;
  // The product of the two eigenvalues that do not vanish: lines are real where it is negative.
  double lowest_product = 0;
  for (const double g :
       cubic_roots((a.transpose() * adjugate_b).trace() / cubic,
                   (adjugate_a.transpose() * b).trace() / cubic, a.determinant() / cubic)) {
    const Eigen::Matrix3d conic = (a + g * b) / (1 + std::abs(g));
    const double product = adjugate(conic).trace();
    if (product >= lowest_product) continue;
    lowest_product = product;
    best = conic;
  }
  return best;
}

/// Where the line `normal . z = 0` meets the conic z' conic z = 0, up to scale.
void append_intersections(const Eigen::Vector3d& normal, const Eigen::Matrix3d& conic,
                          std::vector<Eigen::Vector3d>* directions) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  const Eigen::Vector3d second = normal.normalized().cross(first);
  const double a = first.dot(conic * first);
  const double b = first.dot(conic * second);
  const double c = second.dot(conic * second);
  const double discriminant = b * b - a * c;
  // A double root's discriminant may come out slightly negative; Newton's method mends the rest.
  if (discriminant < -1e-8 * (b * b + std::abs(a * c))) return;
  const double q = -(b + std::copysign(std::sqrt(std::max(0., discriminant)), b));
  directions->emplace_back(q * first + a * second);
  directions->emplace_back(c * first + q * second);
}

/// Newton's method on the laws of cosines; none if it does not get there with positive distances.
std::optional<Eigen::Vector3d> polished(const Triangle& triangle, Eigen::Vector3d s) {
  constexpr std::array<std::array<int, 2>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};
  double error = 0;
  for (int iteration = 0; iteration < 6; ++iteration) {
    Eigen::Vector3d residual;
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    error = 0;
    for (int row = 0; row < 3; ++row) {
      const auto k = static_cast<std::size_t>(row);
      const auto [i, j] = kPairs[k];
      const double chord = triangle.sq_chord[k];
      const double difference = s[i] - s[j];
      residual[row] = difference * difference + s[i] * s[j] * chord - triangle.sq_side[k];
      jacobian(row, i) = 2 * difference + s[j] * chord;
      jacobian(row, j) = -2 * difference + s[i] * chord;
      error = std::max(error, std::abs(residual[row]) / triangle.sq_side[k]);
    }
    if (error < 1e-13) break;
    s -= jacobian.inverse() * residual;
  }
  if (!(error < 1e-8) || !(s.minCoeff() > 0)) return std::nullopt;
  return s;
}

std::vector<Eigen::Vector3d> distances(const Triangle& triangle) {
  const auto& side = triangle.sq_side;
  const double unit = std::sqrt(triangle.sq_chord[0] + triangle.sq_chord[1] + triangle.sq_chord[2]);
  const auto form = quadratic_forms(triangle, unit);
  // The sides, all three divided by the last, leave two homogeneous equations: a pencil of conics.
  Eigen::Matrix3d a = form[0] - side[0] / side[2] * form[2];
  Eigen::Matrix3d b = form[1] - side[1] / side[2] * form[2];
  a /= a.norm();
  b /= b.norm();
  if (std::abs(b.determinant()) < std::abs(a.determinant())) std::swap(a, b);
  const auto degenerate = pair_of_lines(a, b);
  if (!degenerate) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(*degenerate);
  const Eigen::Vector3d plus =
      std::sqrt(std::max(0., eigen.eigenvalues()[2])) * eigen.eigenvectors().col(2);
  const Eigen::Vector3d minus =
      std::sqrt(std::max(0., -eigen.eigenvalues()[0])) * eigen.eigenvectors().col(0);
  std::vector<Eigen::Vector3d> directions;
  append_intersections(plus + minus, b, &directions);
  append_intersections(plus - minus, b, &directions);

  std::vector<Eigen::Vector3d> found;
  for (const Eigen::Vector3d& z : directions) {
    const double s0 = z[0] / unit;
    const Eigen::Vector3d s(s0, s0 + z[1], s0 + z[2]);
    const double scale =
        std::sqrt((side[0] + side[1] + side[2]) / z.dot((form[0] + form[1] + form[2]) * z));
    if (const auto exact = polished(triangle, std::copysign(scale, s0) * s))
      found.push_back(*exact);
  }
  return found;
}

/// Axes of the triangle: along its first side, and its normal.
std::optional<Eigen::Matrix3d> triangle_axes(const std::array<Eigen::Vector3d, 3>& points) {
  const Eigen::Vector3d side = points[1] - points[0];
  const Eigen::Vector3d other = points[2] - points[0];
  const Eigen::Vector3d normal = side.cross(other);
  if (!(normal.norm() > 1e-9 * (side.squaredNorm() + other.squaredNorm()))) return std::nullopt;
  Eigen::Matrix3d axes;
  axes.col(0) = side.normalized();
  axes.col(2) = normal.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

void solve_p3p(const std::array<Eigen::Vector3d, 3>& bearings,
               const std::array<Eigen::Vector3d, 3>& points, std::vector<Pose>* poses) {
  const auto source_axes = triangle_axes(points);
  if (!source_axes) return;
  const auto squares = [](const std::array<Eigen::Vector3d, 3>& p) {
    return std::array<double, 3>{(p[0] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm(),
                                 (p[1] - p[2]).squaredNorm()};
  };
  for (const Eigen::Vector3d& s : distances({squares(points), squares(bearings)})) {
    const auto camera_axes =
        triangle_axes({s[0] * bearings[0], s[1] * bearings[1], s[2] * bearings[2]});
    if (!camera_axes) continue;
    Pose pose = Pose::Identity();
    pose.linear() = *camera_axes * source_axes->transpose();
    pose.translation() = s[0] * bearings[0] - pose.linear() * points[0];
    poses->push_back(pose);
  }
}

}  // namespace lidar_upsampling
