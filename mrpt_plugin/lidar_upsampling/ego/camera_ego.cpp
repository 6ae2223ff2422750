// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/camera_ego.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lidar_upsampling/vision/refine_pose.h"

namespace lidar_upsampling {
namespace {

// The noise of the inliers, per axis, with the expected one as a few more of them; who counts as an
// inlier stays.
AbsolutePoseOptions with_noise(AbsolutePoseOptions options, const AbsolutePose& pose) {
  constexpr double kExpectedCounts = 4;
  constexpr double kFinest_px = 0.05;
  const double gate_px = options.max_inlier_sigmas * options.sigma_px;
  const double sq_sigma = (kExpectedCounts * options.sigma_px * options.sigma_px +
                           0.5 * pose.num_inliers * pose.rmse_px * pose.rmse_px) /
                          (kExpectedCounts + pose.num_inliers);
  options.sigma_px = std::max(kFinest_px, std::sqrt(sq_sigma));
  options.max_inlier_sigmas = gate_px / options.sigma_px;
  return options;
}

/// Of the reprojection errors, Cauchy distributed with scale `sigma_px`: twice a negative
/// log-likelihood, so that differences are likelihood-ratio statistics.
double picture_cost(const std::vector<Correspondence>& correspondences, const CameraModel& camera,
                    const Pose& T_camera_source, double sigma_px) {
  constexpr double kFarOff = 1e6;
  double sum = 0;
  for (const double error : reprojection_errors(correspondences, camera, T_camera_source))
    sum += 2 * std::log1p(std::min(error * error / (sigma_px * sigma_px), kFarOff));
  return sum;
}

/// Likewise of a pose under the prior: its squared Mahalanobis distance.
double prior_cost(const PosePrior& prior, const Pose& T_camera_source) {
  const Pose step = T_camera_source * prior.T_mean.inverse();
  const Eigen::AngleAxisd turn(step.linear());
  Twist increment;
  increment << turn.angle() * turn.axis(), step.translation();
  return (prior.sqrt_information * increment).squaredNorm();
}

/// refine_absolute_pose() from several starts; the answer of least cost, picture and prior
/// together. A crowd of points that moves on its own does not win against a prior that knows
/// better. The picture weighs in by the noise that the inliers show.
std::optional<AbsolutePose> refine_likeliest_pose(
    const std::vector<Correspondence>& correspondences, const CameraModel& camera,
    const std::vector<Pose>& starts, const AbsolutePoseOptions& options, const PosePrior& prior) {
  std::optional<AbsolutePose> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Pose& start : starts) {
    auto pose = refine_absolute_pose(correspondences, camera, start, options, prior);
    if (!pose) continue;
    const double cost =
        picture_cost(correspondences, camera, pose->T_camera_source, options.sigma_px) /
            options.points_per_observation +
        prior_cost(prior, pose->T_camera_source);
    if (cost >= least) continue;
    least = cost;
    best = std::move(pose);
  }
  if (!best) return best;
  auto weighed = refine_absolute_pose(correspondences, camera, best->T_camera_source,
                                      with_noise(options, *best), prior);
  return weighed ? weighed : best;
}

// Points that may better a guess whose covariance is known: three would tell a pose, twice.
constexpr int kEnoughBesideGuess = 6;

/// Takes an increment in the camera frame to the lidar frame's.
Matrix6d lidar_from_camera_increment(const Pose& T_camera_lidar) {
  return increment_at(T_camera_lidar.translation(), T_camera_lidar.linear().transpose());
}

/// W with W' W = covariance^-1.
Matrix6d sqrt_information_of(const Matrix6d& covariance) {
  constexpr double kTurn_rad = 1e-5, kStep_m = 1e-4;  // finer than any picture shows
  Matrix6d regular = covariance;
  regular.diagonal().head<3>().array() += kTurn_rad * kTurn_rad;
  regular.diagonal().tail<3>().array() += kStep_m * kStep_m;
  const Eigen::LLT<Matrix6d> root(regular);
  return root.matrixL().solve(Matrix6d::Identity());
}

PosePrior vehicle_prior(const Pose& T_camera_lidar, const Pose& guess,
                        const CameraEgoOptions& options) {
  PosePrior prior;
  prior.T_mean = T_camera_lidar * guess;
  const Matrix6d weights = options.guess_covariance
                               ? sqrt_information_of(*options.guess_covariance)
                               : Matrix6d(options.sigmas.cwiseInverse().asDiagonal());
  prior.sqrt_information = weights * lidar_from_camera_increment(T_camera_lidar);
  return prior;
}

}  // namespace

std::optional<EgoStep> estimate_camera_ego(const std::vector<Correspondence>& correspondences,
                                           const CameraModel& model, const Pose& T_camera_lidar,
                                           const CameraEgoOptions& options, const Pose& guess) {
  const int enough = options.guess_covariance ? kEnoughBesideGuess : options.min_correspondences;
  if (static_cast<int>(correspondences.size()) < enough) return std::nullopt;
  std::vector<Pose> starts{T_camera_lidar * guess};
  if (!options.trust_guess) {
    const auto free = estimate_absolute_pose(correspondences, model, options.pose, starts.front());
    if (!free) return std::nullopt;
    starts.push_back(free->T_camera_source);
  }
  const auto refined = refine_likeliest_pose(correspondences, model, starts, options.pose,
                                             vehicle_prior(T_camera_lidar, guess, options));
  // With a prior the refinement asks for no number of inliers: we do.
  if (!refined || refined->num_inliers < enough / 2 ||
      refined->num_inliers <
          options.pose.min_inlier_ratio * static_cast<double>(correspondences.size())) {
    return std::nullopt;
  }
  const Pose step = T_camera_lidar.inverse() * refined->T_camera_source;
  const Pose off_guess = step * guess.inverse();
  if (off_guess.translation().norm() > options.max_step_m ||
      rotation_angle(off_guess) > options.max_turn_rad)
    return std::nullopt;
  const Matrix6d J = lidar_from_camera_increment(T_camera_lidar);
  EgoStep ego;
  ego.T_to_from = step;
  ego.covariance = J * refined->covariance * J.transpose();
  return ego;
}

}  // namespace lidar_upsampling
