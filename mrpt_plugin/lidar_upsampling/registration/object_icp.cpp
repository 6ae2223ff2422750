// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/object_icp.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

constexpr double kResidualSigma =
    0.03;  // m, of a good match: what the soft constraints weigh against

/// @param last of the step before, or -1: no match is farther than it, which need not be searched.
PointIndex::Neighbor match_of(const ObjectFit& problem, const Eigen::Vector3f& point, int last) {
  const auto reach = static_cast<float>(problem.options.max_correspondence_m);
  float sq_bound = reach * reach;
  if (last >= 0) {
    const float sq_last = (problem.target.points()[last] - point).squaredNorm();
    sq_bound = std::min(sq_bound, 1.001F * sq_last + 1e-6F);  // a thousandth more, for rounding
  }
  return problem.target.nearest(point, sq_bound);
}

/// Adds one point's match: across the surface with full weight, along it with little.
/// @param match in and out, of the step before and of this one; -1: none.
void add_match(const ObjectFit& problem, const Eigen::Vector3d& point, const Eigen::Vector3d& pivot,
               double scale, int& match, Matrix6d& H, Twist& b) {
  const auto nearest = match_of(problem, point.cast<float>(), match);
  match = nearest.index;
  if (nearest.index < 0) {
    return;
  }
  const Eigen::Vector3d error = point - problem.target.points()[nearest.index].cast<double>();
  const Eigen::Vector3d normal = problem.target.normal(nearest.index).cast<double>();
  const double along = normal.isZero() ? 1 : problem.options.point_weight;
  const Eigen::Matrix3d metric =
      along * Eigen::Matrix3d::Identity() + (1 - along) * normal * normal.transpose();
  const double root = scale * scale / (scale * scale + error.dot(metric * error));
  // J = [-S, I] with S = [point - pivot]x; only the lower triangle of H = J' W J is read.
  const Eigen::Matrix3d weighted = root * root * metric;
  const Eigen::Matrix3d S = skew(point - pivot);
  const Eigen::Matrix3d turned = weighted * S;
  const Eigen::Vector3d pull = weighted * error;
  H.topLeftCorner<3, 3>().noalias() += S.transpose() * turned;
  H.bottomLeftCorner<3, 3>() -= turned;
  H.bottomRightCorner<3, 3>() += weighted;
  b.head<3>() -= (point - pivot).cross(pull);
  b.tail<3>() -= pull;
}

/// Vehicles stay level with the ground: soft, or sparse rings would tilt them.
void add_level(const ObjectFit& problem, const Pose& T, Matrix6d& H, Twist& b) {
  const Eigen::AngleAxisd turned(T.linear() * problem.T_level.linear().transpose());
  const Eigen::Vector3d tilt = turned.angle() * turned.axis();
  const double rise = (T * problem.centroid - problem.T_level * problem.centroid).z();
  const int weigh_as = problem.options.weigh_as;
  const double crowd =
      weigh_as > 0 ? std::max(1., static_cast<double>(problem.points.size()) / weigh_as) : 1;
  const auto weight = [&](double sigma) { return crowd * std::pow(kResidualSigma / sigma, 2); };
  const double tilt_weight = weight(problem.options.tilt_sigma_rad);
  for (int axis = 0; axis < 2; ++axis) {
    H(axis, axis) += tilt_weight;
    b[axis] -= tilt_weight * tilt[axis];
  }
  H(5, 5) += weight(problem.options.height_sigma_m);
  b[5] -= weight(problem.options.height_sigma_m) * rise;
}

}  // namespace

Fitted converge(const ObjectFit& problem, const Pose& guess, double stop) {
  Pose T = guess;
  double scale = 4 * problem.options.kernel_m;
  std::vector<int> matches(problem.points.size(), -1);
  for (int i = 0; i < problem.options.max_iterations; ++i) {
    Matrix6d H = 1e-9 * Matrix6d::Identity();
    Twist b = Twist::Zero();
    const Eigen::Vector3d pivot = T * problem.centroid;
    for (std::size_t j = 0; j < matches.size(); ++j) {
      const Eigen::Vector3d place = T * problem.points[j].cast<double>();
      if (sight_in(problem, place.cast<float>()) == Sight::hidden) continue;
      add_match(problem, place, pivot, scale, matches[j], H, b);
    }
    add_level(problem, T, H, b);
    const Twist step = H.ldlt().solve(b);
    if (!step.allFinite()) {
      break;
    }
    T = renormalized(Eigen::Translation3d(pivot) * exp_se3(step) * Eigen::Translation3d(-pivot) *
                     T);
    if (scale <= problem.options.kernel_m && step.norm() < stop) {
      break;
    }
    scale = std::max(problem.options.kernel_m, 0.75 * scale);
  }
  const double score = score_of(problem, T);
  return {T, score, rank_of(problem, T, score)};
}

Pose shifted_by(const Pose& T, double x, double y) { return Eigen::Translation3d(x, y, 0) * T; }

}  // namespace lidar_upsampling
