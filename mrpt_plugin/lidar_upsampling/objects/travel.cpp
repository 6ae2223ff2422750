// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/travel.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

using Matrix24d = Eigen::Matrix<double, 2, 4>;

Matrix24d weights_of(double velocity, double acceleration) {
  Matrix24d weights;
  weights << velocity * Eigen::Matrix2d::Identity(), acceleration * Eigen::Matrix2d::Identity();
  return weights;
}

LevelGaussian seen_through(const Matrix24d& weights, const Travel& travel) {
  return {weights * travel.mean, weights * travel.covariance * weights.transpose()};
}

}  // namespace

Travel expect_travel(const std::optional<KnownMotion>& known, Stamp key_stamp,
                     const Eigen::Matrix3d& R_lidar_k_rest, const MotionPriorOptions& options) {
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  const double sq_acceleration = options.acceleration_sigma * options.acceleration_sigma;
  Travel travel;
  travel.covariance.bottomRightCorner<2, 2>() = sq_acceleration * I;
  if (!known) {
    travel.covariance.topLeftCorner<2, 2>() =
        options.unknown_speed_sigma * options.unknown_speed_sigma * I;
    return travel;
  }
  const double age = std::max(0., seconds_between(known->stamp, key_stamp));
  if (known->travel) return turned(later(*known->travel, age, options), R_lidar_k_rest);
  // It has accelerated since it was measured, as it goes on to do.
  const Eigen::Matrix2d turn = R_lidar_k_rest.topLeftCorner<2, 2>();
  travel.mean.head<2>() = (R_lidar_k_rest * known->velocity_at_rest).head<2>();
  travel.covariance.topLeftCorner<2, 2>() =
      turn * known->velocity_covariance * turn.transpose() + age * age * sq_acceleration * I;
  travel.covariance.topRightCorner<2, 2>() = age * sq_acceleration * I;
  travel.covariance.bottomLeftCorner<2, 2>() = age * sq_acceleration * I;
  return travel;
}

Travel having_seen(const Travel& travel, const LevelGaussian& step, double dt) {
  const Matrix24d weights = weights_of(dt, 0.5 * dt * dt);
  const LevelGaussian expected = seen_through(weights, travel);
  const Eigen::Matrix<double, 4, 2> gain =
      travel.covariance * weights.transpose() *
      Eigen::Matrix2d(expected.covariance + step.covariance).inverse();
  Travel result;
  result.mean = travel.mean + gain * (step.mean - expected.mean);
  const Eigen::Matrix4d rest = Eigen::Matrix4d::Identity() - gain * weights;
  result.covariance =
      rest * travel.covariance * rest.transpose() + gain * step.covariance * gain.transpose();
  return result;
}

Travel later(const Travel& travel, double dt, const MotionPriorOptions& options) {
  constexpr double kLasts_s = 1;
  const double left = std::exp(-dt / kLasts_s);
  Eigen::Matrix4d change = Eigen::Matrix4d::Identity();
  change.topRightCorner<2, 2>() = dt * Eigen::Matrix2d::Identity();
  change.bottomRightCorner<2, 2>() = left * Eigen::Matrix2d::Identity();
  Travel result{change * travel.mean, change * travel.covariance * change.transpose()};
  const double fresh = (1 - left * left) * options.acceleration_sigma * options.acceleration_sigma;
  result.covariance.bottomRightCorner<2, 2>() += fresh * Eigen::Matrix2d::Identity();
  return result;
}

Travel turned(const Travel& travel, const Eigen::Matrix3d& R) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Zero();
  turn.topLeftCorner<2, 2>() = R.topLeftCorner<2, 2>();
  turn.bottomRightCorner<2, 2>() = R.topLeftCorner<2, 2>();
  return {turn * travel.mean, turn * travel.covariance * turn.transpose()};
}

LevelGaussian step_at(const Travel& travel, double dt) {
  return seen_through(weights_of(dt, 0.5 * dt * dt), travel);
}

LevelGaussian velocity_at(const Travel& travel, double dt) {
  return seen_through(weights_of(1, dt), travel);
}

double disagreement(const LevelGaussian& a, const LevelGaussian& b) {
  const Eigen::Vector2d apart = a.mean - b.mean;
  return apart.dot(Eigen::Matrix2d(a.covariance + b.covariance).ldlt().solve(apart));
}

}  // namespace lidar_upsampling
