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

/// Where each picture has the moved object: from points about the centroid to the camera's frame.
std::vector<Eigen::Isometry3d> placed(const ImageFactor& image, const Eigen::Vector3d& centroid,
                                      const Twist& motion) {
  const Eigen::Matrix3d R = rotation_exp(motion.head<3>());
  std::vector<Eigen::Isometry3d> result;
  for (const ImageView& view : image.views) {
    Eigen::Isometry3d& T = result.emplace_back();
    T.linear() = view.T_camera_lidar_k.linear() * R;
    T.translation() =
        view.T_camera_lidar_k * (centroid + view.share * motion.tail<3>() + view.offset);
  }
  return result;
}

/// Where a moved point is seen, against where it was found.
struct Residual {
  Eigen::Vector2d px;
  Eigen::Vector3d arm;  ///< from the centroid; camera frame
  Eigen::Vector2d normalised;
  double depth;
};

std::optional<Residual> residual_of(const Observation& observation, const Eigen::Vector3d& centroid,
                                    const Eigen::Isometry3d& T_camera_centroid) {
  const Eigen::Vector3d arm = T_camera_centroid.linear() * (observation.point_in_source - centroid);
  const Eigen::Vector3d at = arm + T_camera_centroid.translation();
  if (at.z() * std::abs(at.z()) < kSqNearest_m) return std::nullopt;
  const Eigen::Vector2d normalised = at.head<2>() / at.z();
  return Residual{observation.pixel_by_normalised * (normalised - observation.normalised), arm,
                  normalised, at.z()};
}

/// The residual's derivatives, transposed, by a motion in the camera's frame.
Eigen::Matrix<double, 6, 2> by_motion(const Residual& residual, const Observation& observation,
                                      double share) {
  const Eigen::Matrix2d by_offset = observation.pixel_by_normalised / residual.depth;
  Eigen::Matrix<double, 6, 2> result;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d across = by_offset.row(axis);
    const Eigen::Vector3d by_point(across.x(), across.y(), -across.dot(residual.normalised));
    result.col(axis) << residual.arm.cross(by_point), share * by_point;
  }
  return result;
}

/// Of log(1 + x), with a logarithm for many.
class LogSum {
 public:
  void add(double x) {
    constexpr double kNearlyFull = 1e150;  // of 1e308: no term is as large as what is left
    product_ *= 1 + x;
    if (product_ < kNearlyFull) return;
    sum_ += std::log(product_);
    product_ = 1;
  }
  [[nodiscard]] double value() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1, sum_ = 0;
};

/// The problem of one hypothesis.
struct Problem {
  const ImageFactor& image;
  const Eigen::Vector3d& centroid;
  const MotionExpected& prior;
  Matrix6d information;  ///< of the prior
  double sigma_px;
  const PointNoise& noise;
};

double picture_cost(const Problem& problem, const Twist& motion) {
  const double nu = problem.noise.degrees_of_freedom;
  const double sq_scale = nu * problem.sigma_px * problem.sigma_px;
  constexpr double kFarOff = 1e6;  // of a point that the picture cannot show
  const ImageFactor& image = problem.image;
  const auto views = placed(image, problem.centroid, motion);
  LogSum sum;
  for (std::size_t i = 0; i < image.observations.size(); ++i) {
    const auto at = residual_of(image.observations[i], problem.centroid, views[image.view_of[i]]);
    sum.add(at ? at->px.squaredNorm() / sq_scale : kFarOff);
  }
  return (nu + 2) * sum.value() / problem.noise.points_per_observation;
}

double cost_of(const Problem& problem, const Twist& motion) {
  const Twist astray = motion - problem.prior.mean;
  return picture_cost(problem, motion) + astray.dot(problem.information * astray);
}

struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Twist b = Twist::Zero();
};

NormalEquations linearised(const Problem& problem, const Twist& motion) {
  const ImageFactor& image = problem.image;
  const double nu = problem.noise.degrees_of_freedom;
  const double sq_sigma = problem.sigma_px * problem.sigma_px;
  const auto views = placed(image, problem.centroid, motion);
  std::vector<NormalEquations> in_camera(views.size());
  for (std::size_t i = 0; i < image.observations.size(); ++i) {
    const int view = image.view_of[i];
    const auto at = residual_of(image.observations[i], problem.centroid, views[view]);
    if (!at) continue;
    const auto J = by_motion(*at, image.observations[i], image.views[view].share);
    const double weight =
        (nu + 2) / (nu * sq_sigma + at->px.squaredNorm()) / problem.noise.points_per_observation;
    const Eigen::Matrix<double, 6, 2> weighted = weight * J;
    in_camera[view].H.noalias() += weighted * J.transpose();
    in_camera[view].b.noalias() -= weighted * at->px;
  }
  NormalEquations result{problem.information, problem.information * (problem.prior.mean - motion)};
  for (std::size_t view = 0; view < views.size(); ++view) {
    Matrix6d turn = Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
        image.views[view].T_camera_lidar_k.linear();
    result.H += turn.transpose() * in_camera[view].H * turn;
    result.b += turn.transpose() * in_camera[view].b;
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
  const ImageFactor& image = problem.image;
  const auto views = placed(image, problem.centroid, fit.mean);
  double sum = 0;
  for (std::size_t i = 0; i < image.observations.size(); ++i) {
    const auto at = residual_of(image.observations[i], problem.centroid, views[image.view_of[i]]);
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
  fit.sigma_px = sigma_px;
  const Matrix6d H = linearised(problem, fit.mean).H;
  fit.covariance = inverse(H);
  fit.log_evidence = -0.5 * (fit.cost + std::log(determinant(H * prior.covariance)));
  count_inliers(problem, fit);
  return fit;
}

double measured_sigma_px(const ImageFactor& image, const Eigen::Vector3d& centroid,
                         const Twist& motion, const PointNoise& noise) {
  constexpr double kFinest_px = 0.1;
  const auto views = placed(image, centroid, motion);
  const double nu = noise.degrees_of_freedom;
  double sq_sigma = noise.sigma_px * noise.sigma_px;
  for (int round = 0; round < 5; ++round) {
    double sum = 0;
    for (std::size_t i = 0; i < image.observations.size(); ++i) {
      const auto at = residual_of(image.observations[i], centroid, views[image.view_of[i]]);
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
  T.linear() = rotation_exp(motion.head<3>());
  T.translation() = centroid + motion.tail<3>() - T.linear() * centroid;
  return T;
}

}  // namespace lidar_upsampling
