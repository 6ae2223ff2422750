// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/object_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/registration/nearest_point.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

bool are_enough(const ObjectFit& fit, int visible, int all) {
  constexpr double kLeastShare = 0.25;
  const double least = fit.options.min_points / static_cast<double>(fit.points.size());
  return visible == all || visible >= std::max(kLeastShare, least) * all;
}

constexpr double kResidualSigma =
    0.03;  // m, of a good match: what the soft constraints weigh against

/// Sums over matches: across the surface each counts fully, along it little.
struct MatchSums {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  ///< of the places about the pivot
  Eigen::Vector3d places = Eigen::Vector3d::Zero(), errors = Eigen::Vector3d::Zero(),
                  moments = Eigen::Vector3d::Zero();
  double weights = 0;
  Matrix6d H = Matrix6d::Zero();  ///< across the surfaces
  Twist b = Twist::Zero();

  /// J = [-[p]x, I] at a place p: what counts in any direction needs no more than the sums.
  void add_to(Matrix6d& all_H, Twist& all_b) const {
    all_H += H;
    all_b += b;
    all_H.topLeftCorner<3, 3>() += squares.trace() * Eigen::Matrix3d::Identity() - squares;
    all_H.bottomLeftCorner<3, 3>() -= skew(places);
    all_H.bottomRightCorner<3, 3>().diagonal().array() += weights;
    all_b.head<3>() -= moments;
    all_b.tail<3>() -= errors;
  }
};

void add_match(const ObjectFit& problem, const Eigen::Vector3d& point, const Eigen::Vector3d& pivot,
               double scale, int match, MatchSums& sums) {
  const Eigen::Vector3d error = point - problem.target.points()[match].cast<double>();
  const Eigen::Vector3d normal = problem.target.normal(match).cast<double>();
  const Eigen::Vector3d place = point - pivot;
  const double across = normal.dot(error);  // zero where there is no normal
  const double along = normal.isZero() ? 1 : problem.options.point_weight;
  const double sq_error = along * error.squaredNorm() + (1 - along) * across * across;
  const double root = scale * scale / (scale * scale + sq_error);
  const double weight = root * root * along;
  sums.weights += weight;
  sums.places += weight * place;
  sums.squares.noalias() += weight * place * place.transpose();
  sums.errors += weight * error;
  sums.moments += weight * place.cross(error);
  Twist row;
  row << place.cross(normal), normal;
  const Twist weighed = root * root * (1 - along) * row;
  sums.H.noalias() += weighed * row.transpose();
  sums.b -= across * weighed;
}

/// Vehicles stay level with the ground, or sparse rings would tilt them, and turn slowly, or what
/// is seen of a corner would turn to lie along a side: both soft.
void add_level(const ObjectFit& problem, const Pose& T, Matrix6d& H, Twist& b) {
  const Eigen::AngleAxisd turned(T.linear() * problem.T_level.linear().transpose());
  const Eigen::Vector3d turn = turned.angle() * turned.axis();
  const double rise = (T * problem.centroid - problem.T_level * problem.centroid).z();
  const int weigh_as = problem.options.weigh_as;
  const double crowd =
      weigh_as > 0 ? std::max(1., static_cast<double>(problem.points.size()) / weigh_as) : 1;
  const auto weight = [&](double sigma) { return crowd * std::pow(kResidualSigma / sigma, 2); };
  const double yaw_sigma = problem.options.yaw_sigma_rad;
  const double tilt_weight = weight(problem.options.tilt_sigma_rad);
  for (int axis = 0; axis < 2; ++axis) {
    H(axis, axis) += tilt_weight;
    b[axis] -= tilt_weight * turn[axis];
  }
  if (yaw_sigma > 0) {
    H(2, 2) += weight(yaw_sigma);
    b[2] -= weight(yaw_sigma) * turn[2];
  }
  H(5, 5) += weight(problem.options.height_sigma_m);
  b[5] -= weight(problem.options.height_sigma_m) * rise;
}

constexpr auto kFarthest = static_cast<float>(kScoreCut * kScoreCut);  // m^2

/// @param sq_distance of a place to the target, as far as it counts; of the i-th point.
template <typename Distance>
double score_by(const ObjectFit& fit, const Pose& T_target_object, int stride,
                const Distance& sq_distance) {
  const Eigen::Isometry3f T = T_target_object.cast<float>();
  const double just_covered = fit.options.overlap_distance_m;
  double sum = 0;
  int count = 0, visible = 0;
  for (std::size_t i = 0; i < fit.points.size(); i += stride, ++count) {
    const Eigen::Vector3f place = T * fit.points[i];
    const Sight sight = sight_in(fit, place);
    visible += sight == Sight::hidden ? 0 : 1;
    sum += sight == Sight::hidden ? just_covered * just_covered : sq_distance(place, i);
  }
  return are_enough(fit, visible, count) ? std::sqrt(sum / count) : kScoreCut;
}

/// As score_of, from what iterations found.
double score_by_matches(const ObjectFit& fit, const Pose& T_target_object,
                        std::vector<NearestPoint>& matches) {
  const auto reach = static_cast<float>(fit.options.max_correspondence_m);
  return score_by(fit, T_target_object, 1, [&](const Eigen::Vector3f& place, std::size_t i) {
    look_up(fit.target, place, reach, matches[i]);
    if (matches[i].index < 0) return kFarthest;
    return std::min(kFarthest, (fit.target.points()[matches[i].index] - place).squaredNorm());
  });
}

}  // namespace

Sight sight_in(const ObjectFit& fit, const Eigen::Vector3f& place) {
  return fit.seen == nullptr ? Sight::open : fit.seen->at(place);
}

double score_of(const ObjectFit& fit, const Pose& T_target_object, int stride) {
  return score_by(fit, T_target_object, stride, [&](const Eigen::Vector3f& place, std::size_t) {
    return fit.target.nearest(place, kFarthest).sq_distance;
  });
}

SurfaceResidual residual_of(const ObjectFit& fit, const Pose& T_target_object) {
  double sum = 0;
  int count = 0;
  for (const auto& point : fit.points) {
    const Eigen::Vector3f at = T_target_object.cast<float>() * point;
    if (sight_in(fit, at) == Sight::hidden) continue;
    const auto nearest = fit.target.nearest(at);
    const Eigen::Vector3f normal = fit.target.normal(nearest.index);
    const Eigen::Vector3f error = at - fit.target.points()[nearest.index];
    const double sq = normal.isZero() ? error.squaredNorm() : std::pow(normal.dot(error), 2);
    sum += std::min(sq, kScoreCut * kScoreCut);
    ++count;
  }
  return {std::sqrt(sum / std::max(1, count)), count};
}

Sampling sampling_under(const ObjectFit& fit, const Pose& T_target_object) {
  const Eigen::Isometry3f T = T_target_object.cast<float>();
  const auto reach = static_cast<float>(std::pow(fit.options.overlap_distance_m, 2));
  Eigen::Matrix2d all = 1e-9 * Eigen::Matrix2d::Identity(), along = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d faces = Eigen::Matrix2d::Zero();
  std::vector<float> spacings;
  for (const Eigen::Vector3f& point : fit.points) {
    const Eigen::Vector3f place = T * point;
    if (sight_in(fit, place) == Sight::hidden) continue;
    const auto nearest = fit.target.nearest(place, reach);
    if (nearest.index < 0) continue;
    spacings.push_back(fit.target.spacing(nearest.index));
    const Eigen::Vector3d normal = fit.target.normal(nearest.index).cast<double>();
    const Eigen::Matrix2d across = (normal * normal.transpose()).topLeftCorner<2, 2>();
    const double weight = normal.isZero() ? 1 : fit.options.point_weight;
    along += weight * (Eigen::Matrix2d::Identity() - across);
    all += weight * (Eigen::Matrix2d::Identity() - across) + across;
    faces += across;
  }
  if (spacings.empty()) return {};
  return {median(std::move(spacings)), all.inverse() * along,
          symmetric_eigen<2>(faces).vectors.col(0)};
}

double overlap_of(const ObjectFit& fit, const Pose& T_target_object) {
  const Eigen::Isometry3f T = T_target_object.cast<float>();
  const auto reach = static_cast<float>(fit.options.overlap_distance_m);
  int visible = 0, covered = 0;
  for (const Eigen::Vector3f& point : fit.points) {
    const Eigen::Vector3f place = T * point;
    if (sight_in(fit, place) == Sight::hidden) continue;
    ++visible;
    covered += fit.target.nearest(place, reach * reach).index >= 0 ? 1 : 0;
  }
  const bool tells = are_enough(fit, visible, static_cast<int>(fit.points.size()));
  return tells ? static_cast<double>(covered) / visible : 0;
}

Fitted converge(const ObjectFit& problem, const Pose& guess, double stop, double widening) {
  Pose T = guess;
  double scale = widening * problem.options.kernel_m;
  const auto reach = static_cast<float>(problem.options.max_correspondence_m);
  std::vector<NearestPoint> matches(problem.points.size());
  for (int i = 0; i < problem.options.max_iterations; ++i) {
    MatchSums sums;
    const Eigen::Vector3d pivot = T * problem.centroid;
    for (std::size_t j = 0; j < matches.size(); ++j) {
      const Eigen::Vector3d place = T * problem.points[j].cast<double>();
      if (sight_in(problem, place.cast<float>()) == Sight::hidden) continue;
      look_up(problem.target, place.cast<float>(), reach, matches[j]);
      if (matches[j].index >= 0) add_match(problem, place, pivot, scale, matches[j].index, sums);
    }
    Matrix6d H = 1e-9 * Matrix6d::Identity();
    Twist b = Twist::Zero();
    sums.add_to(H, b);
    add_level(problem, T, H, b);
    const Twist step = solved<6, 1>(H, b);
    if (!step.allFinite()) {
      break;
    }
    T = renormalized(Eigen::Translation3d(pivot) * exp_se3(step) * Eigen::Translation3d(-pivot) *
                     T);
    if (scale <= problem.options.kernel_m && step.norm() < stop) {
      break;
    }
    scale = std::max(problem.options.kernel_m, 0.5 * scale);
  }
  return {T, score_by_matches(problem, T, matches)};
}

}  // namespace lidar_upsampling
