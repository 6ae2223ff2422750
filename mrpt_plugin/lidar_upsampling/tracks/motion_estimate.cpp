// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/motion_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lidar_upsampling/decompositions.h"

namespace lidar_upsampling {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kExpectedCounts = 4;  // points that the expected scatter counts as
constexpr double kSqNearest_m = 1e-2;  // depth squared: what is nearer says nothing

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

/// Where a moved point is seen, against where it was found.
struct Residual {
  Eigen::Vector2d px;
  Eigen::Vector3d arm;  ///< from the centroid, turned
  Eigen::Vector2d normalised;
  double depth;
};

/// A motion with what every observation needs of it.
struct Moved {
  Eigen::Matrix3d R;
  Eigen::Vector3d d;
  Eigen::Vector3d centroid;
};

std::optional<Residual> residual_of(const Observation& observation, const ImageView& view,
                                    const Moved& moved) {
  const Eigen::Vector3d arm = moved.R * (observation.point_in_source - moved.centroid);
  const Eigen::Vector3d at =
      view.T_camera_lidar_k * (arm + moved.centroid + view.share * moved.d + view.offset);
  if (at.z() * std::abs(at.z()) < kSqNearest_m) return std::nullopt;
  const Eigen::Vector2d normalised = at.head<2>() / at.z();
  return Residual{observation.pixel_by_normalised * (normalised - observation.normalised), arm,
                  normalised, at.z()};
}

Eigen::Matrix<double, 2, 6> by_motion(const Residual& residual, const Observation& observation,
                                      const ImageView& view) {
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << 1, 0, -residual.normalised.x(), 0, 1, -residual.normalised.y();
  by_point =
      observation.pixel_by_normalised * by_point * view.T_camera_lidar_k.linear() / residual.depth;
  Eigen::Matrix<double, 2, 6> result;
  result << -by_point * skew(residual.arm), view.share * by_point;
  return result;
}

/// The problem of one hypothesis.
struct Problem {
  const ImageFactor& image;
  const Eigen::Vector3d& centroid;
  const MotionExpected& prior;
  Matrix6d information;  ///< of the prior
  double sigma_px;
  const PointNoise& noise;
};

double picture_cost(const Problem& problem, const Moved& moved) {
  const double nu = problem.noise.degrees_of_freedom;
  const double sq_scale = nu * problem.sigma_px * problem.sigma_px;
  constexpr double kFarOff = 1e6;  // of a point that the picture cannot show
  double sum = 0;
  for (std::size_t i = 0; i < problem.image.observations.size(); ++i) {
    const auto at = residual_of(problem.image.observations[i],
                                problem.image.views[problem.image.view_of[i]], moved);
    sum += std::log1p(at ? at->px.squaredNorm() / sq_scale : kFarOff);
  }
  return (nu + 2) * sum / problem.noise.points_per_observation;
}

double cost_of(const Problem& problem, const Twist& motion) {
  const Twist astray = motion - problem.prior.mean;
  return picture_cost(problem,
                      {rotation_of(motion.head<3>()), motion.tail<3>(), problem.centroid}) +
         astray.dot(problem.information * astray);
}

struct NormalEquations {
  Matrix6d H;
  Twist b;
};

NormalEquations linearised(const Problem& problem, const Twist& motion) {
  const double nu = problem.noise.degrees_of_freedom;
  const double sq_sigma = problem.sigma_px * problem.sigma_px;
  const Moved moved{rotation_of(motion.head<3>()), motion.tail<3>(), problem.centroid};
  NormalEquations result{problem.information, problem.information * (problem.prior.mean - motion)};
  for (std::size_t i = 0; i < problem.image.observations.size(); ++i) {
    const Observation& observation = problem.image.observations[i];
    const ImageView& view = problem.image.views[problem.image.view_of[i]];
    const auto at = residual_of(observation, view, moved);
    if (!at) continue;
    const Eigen::Matrix<double, 2, 6> J = by_motion(*at, observation, view);
    const double weight =
        (nu + 2) / (nu * sq_sigma + at->px.squaredNorm()) / problem.noise.points_per_observation;
    result.H.noalias() += weight * J.transpose() * J;
    result.b.noalias() -= weight * J.transpose() * at->px;
  }
  return result;
}

/// Gauss-Newton; a step that makes things worse is halved.
Twist descend(const Problem& problem, Twist motion, double& cost) {
  cost = cost_of(problem, motion);
  for (int i = 0; i < kMaxIterations; ++i) {
    const NormalEquations equations = linearised(problem, motion);
    Twist step = solved<6, 1>(equations.H, equations.b);
    const double gain_hoped = step.dot(equations.b);
    double better = cost_of(problem, motion + step);
    for (int halved = 0; halved < 4 && !(better < cost); ++halved) {
      step *= 0.5;
      better = cost_of(problem, motion + step);
    }
    if (!(better < cost)) break;
    motion += step;
    cost = better;
    if (gain_hoped < 1e-4) break;
  }
  return motion;
}

void count_inliers(const Problem& problem, MotionFit& fit) {
  const Moved moved{rotation_of(fit.mean.head<3>()), fit.mean.tail<3>(), problem.centroid};
  double sum = 0;
  for (std::size_t i = 0; i < problem.image.observations.size(); ++i) {
    const auto at = residual_of(problem.image.observations[i],
                                problem.image.views[problem.image.view_of[i]], moved);
    if (!at || at->px.norm() > 3 * problem.noise.sigma_px) continue;
    ++fit.num_inliers;
    sum += at->px.squaredNorm();
  }
  if (fit.num_inliers > 0) fit.rmse_px = std::sqrt(sum / fit.num_inliers);
}

}  // namespace

void ImageFactor::add(const ImageView& view, const std::vector<Observation>& seen) {
  view_of.insert(view_of.end(), seen.size(), static_cast<int>(views.size()));
  views.push_back(view);
  observations.insert(observations.end(), seen.begin(), seen.end());
}

MotionFit fit_motion(const ImageFactor& image, const Eigen::Vector3d& centroid,
                     const MotionExpected& prior, const std::vector<Twist>& starts, double sigma_px,
                     const PointNoise& noise) {
  const Problem problem{image, centroid, prior, inverse(prior.covariance), sigma_px, noise};
  MotionFit fit;
  fit.cost = std::numeric_limits<double>::infinity();
  for (const Twist& start : starts) {
    double cost = 0;
    const Twist mode = descend(problem, start, cost);
    if (cost >= fit.cost) continue;
    fit.cost = cost;
    fit.mean = mode;
  }
  const Matrix6d H = linearised(problem, fit.mean).H;
  fit.covariance = inverse(H);
  fit.log_evidence = -0.5 * (fit.cost + std::log(determinant(H * prior.covariance)));
  count_inliers(problem, fit);
  return fit;
}

double measured_sigma_px(const ImageFactor& image, const Eigen::Vector3d& centroid,
                         const Twist& motion, const PointNoise& noise) {
  constexpr double kFinest_px = 0.1;
  const Moved moved{rotation_of(motion.head<3>()), motion.tail<3>(), centroid};
  const double nu = noise.degrees_of_freedom;
  double sq_sigma = noise.sigma_px * noise.sigma_px;
  for (int round = 0; round < 5; ++round) {
    double sum = 0;
    for (std::size_t i = 0; i < image.observations.size(); ++i) {
      const auto at = residual_of(image.observations[i], image.views[image.view_of[i]], moved);
      const double sq = at ? at->px.squaredNorm() : 1e6;
      sum += 0.5 * (nu + 2) / (nu + sq / sq_sigma) * sq;
    }
    const auto count = static_cast<double>(image.observations.size());
    sq_sigma =
        (kExpectedCounts * noise.sigma_px * noise.sigma_px + sum) / (kExpectedCounts + count);
  }
  return std::max(kFinest_px, std::sqrt(sq_sigma));
}

MotionFit fit_with_scatter(const ImageFactor& image, const Eigen::Vector3d& centroid,
                           const MotionExpected& prior, const std::vector<Twist>& starts,
                           const PointNoise& noise) {
  const MotionFit first = fit_motion(image, centroid, prior, starts, noise.sigma_px, noise);
  const double sigma_px = measured_sigma_px(image, centroid, first.mean, noise);
  MotionFit fit = fit_motion(image, centroid, prior, {first.mean}, sigma_px, noise);
  const double sq_ratio = std::pow(sigma_px / noise.sigma_px, 2);
  const auto count = static_cast<double>(image.observations.size());
  fit.log_evidence -=
      ((count + kExpectedCounts) * std::log(sq_ratio) + kExpectedCounts * (1 / sq_ratio - 1)) /
      noise.points_per_observation;
  return fit;
}

Pose motion_pose(const Twist& motion, const Eigen::Vector3d& centroid) {
  Pose T = Pose::Identity();
  T.linear() = rotation_of(motion.head<3>());
  T.translation() = centroid + motion.tail<3>() - T.linear() * centroid;
  return T;
}

}  // namespace lidar_upsampling
