// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/track_state.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

/// The transition and its derivative.
struct Transition {
  Twist mean;
  Matrix6d by_state = Matrix6d::Identity();
};

Transition transition(const Twist& from, double dt) {
  const double turn = from[5] * dt;
  const Eigen::Rotation2Dd turned(turn), halfway(0.5 * turn);
  const Eigen::Vector2d velocity = from.segment<2>(3);
  // sin(x) / x of half of the turn: the chord of the arc.
  const double chord = std::abs(turn) < 1e-6 ? 1 : std::sin(0.5 * turn) / (0.5 * turn);
  Transition result;
  result.mean << from.head<2>() + dt * chord * (halfway * velocity), from[2] + turn,
      turned * velocity, from[5];
  const Eigen::Vector2d aside(-velocity.y(), velocity.x());
  result.by_state.block<2, 2>(0, 3) = dt * chord * halfway.toRotationMatrix();
  result.by_state.block<2, 1>(0, 5) = 0.5 * dt * dt * (halfway * aside);
  result.by_state(2, 5) = dt;
  result.by_state.block<2, 2>(3, 3) = turned.toRotationMatrix();
  result.by_state.block<2, 1>(3, 5) = dt * (turned * aside);
  return result;
}

Matrix6d process_noise(double dt, double acceleration, const MotionNoise& noise) {
  Matrix6d result = Matrix6d::Zero();
  const double along = std::max(acceleration, noise.acceleration);
  const double density[3] = {along, along, noise.yaw_acceleration};
  for (int i = 0; i < 3; ++i) {
    result(i, i) = density[i] * dt * dt * dt / 3;
    result(i, i + 3) = result(i + 3, i) = density[i] * dt * dt / 2;
    result(i + 3, i + 3) = density[i] * dt;
  }
  return result;
}

Eigen::Matrix<double, 6, 3> gain(const TrackState& state, const Eigen::Matrix3d& of_step) {
  return of_step.ldlt().solve(state.covariance.topRows<3>()).transpose();
}

}  // namespace

double gaussian_density(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance) {
  return std::exp(-0.5 * astray.dot(covariance.inverse() * astray)) /
         (2 * M_PI * std::sqrt(covariance.determinant()));
}

TrackState new_track_state(Stamp stamp, const MotionNoise& noise) {
  TrackState state;
  state.stamp = stamp;
  state.covariance.diagonal() << 0, 0, 0, std::pow(noise.unknown_speed_sigma, 2),
      std::pow(noise.unknown_speed_sigma, 2), std::pow(noise.unknown_yaw_rate_sigma, 2);
  return state;
}

TrackState along_road(TrackState state, double heading, const MotionNoise& noise) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(heading).toRotationMatrix();
  const Eigen::Vector2d sigma(noise.unknown_speed_sigma, noise.aside_speed_sigma);
  state.covariance.block<2, 2>(3, 3) = R * sigma.cwiseAbs2().asDiagonal() * R.transpose();
  return state;
}

TrackState predicted(const TrackState& state, Stamp stamp, const MotionNoise& noise) {
  const double dt = seconds_between(state.stamp, stamp);
  if (dt <= 0) return state;
  const Transition to = transition(state.mean, dt);
  return {stamp, to.mean,
          to.by_state * state.covariance * to.by_state.transpose() +
              process_noise(dt, state.acceleration, noise),
          state.acceleration};
}

TrackState updated(const TrackState& state, const PlanarStep& before, const PlanarStep& after) {
  const auto K = gain(state, before.covariance);
  TrackState result = state;
  result.mean += K * (after.mean - before.mean);
  result.covariance -= K * (before.covariance - after.covariance) * K.transpose();
  return result;
}

TrackState updated(const TrackState& state, const PlanarStep& measured) {
  const auto K = gain(state, state.step().covariance + measured.covariance);
  TrackState result = state;
  result.mean += K * (measured.mean - state.mean.head<3>());
  result.covariance -= K * state.covariance.topRows<3>();
  return result;
}

TrackState smoothed(const TrackState& state, const TrackState& later, const MotionNoise& noise) {
  const double dt = seconds_between(state.stamp, later.stamp);
  if (dt <= 0) return later;
  const TrackState forward = predicted(state, later.stamp, noise);
  const Matrix6d across = transition(state.mean, dt).by_state * state.covariance;
  const Matrix6d K = forward.covariance.ldlt().solve(across).transpose();
  TrackState result = state;
  result.mean += K * (later.mean - forward.mean);
  result.covariance += K * (later.covariance - forward.covariance) * K.transpose();
  return result;
}

TrackState with_velocity(const TrackState& state, const TrackState& known) {
  const Eigen::Matrix3d of_velocity = state.covariance.bottomRightCorner<3, 3>();
  const Eigen::Matrix<double, 6, 3> K =
      of_velocity.ldlt().solve(state.covariance.bottomRows<3>()).transpose();
  TrackState result = state;
  result.mean += K * (known.mean - state.mean).tail<3>();
  result.covariance +=
      K * (known.covariance.bottomRightCorner<3, 3>() - of_velocity) * K.transpose();
  return result;
}

TrackState from_here(TrackState state) {
  state.mean.head<3>().setZero();
  state.covariance.topRows<3>().setZero();
  state.covariance.leftCols<3>().setZero();
  return state;
}

}  // namespace lidar_upsampling
