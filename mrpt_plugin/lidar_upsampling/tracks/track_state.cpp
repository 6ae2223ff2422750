// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/track_state.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/decompositions.h"

namespace lidar_upsampling {
namespace {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

/// The transition and its derivative.
struct Transition {
  Vector8d mean;
  Matrix8d by_state = Matrix8d::Identity();
};

Transition transition(const Vector8d& from, double dt, const MotionNoise& noise) {
  const double turn = from[5] * dt;
  const Eigen::Rotation2Dd turned(turn), halfway(0.5 * turn);
  const double T = noise.acceleration_time, lasts = std::exp(-dt / T);
  const double in_velocity = T * (1 - lasts), in_place = T * (dt - in_velocity);
  const Eigen::Vector2d a = from.tail<2>(), v = from.segment<2>(3), v_later = v + in_velocity * a;
  // sin(x) / x of half of the turn: the chord of the arc.
  const double chord = std::abs(turn) < 1e-6 ? 1 : std::sin(0.5 * turn) / (0.5 * turn);
  const Eigen::Vector2d step = halfway * Eigen::Vector2d(dt * chord * v + in_place * a);
  Transition result;
  result.mean << from.head<2>() + step, from[2] + turn, turned * v_later, from[5],
      turned * Eigen::Vector2d(lasts * a);
  const auto by_turn = [&](const Eigen::Vector2d& d) { return Eigen::Vector2d(-d.y(), d.x()); };
  result.by_state.block<2, 2>(0, 3) = dt * chord * halfway.toRotationMatrix();
  result.by_state.block<2, 1>(0, 5) = 0.5 * dt * by_turn(step);
  result.by_state.block<2, 2>(0, 6) = in_place * halfway.toRotationMatrix();
  result.by_state(2, 5) = dt;
  result.by_state.block<2, 2>(3, 3) = turned.toRotationMatrix();
  result.by_state.block<2, 1>(3, 5) = dt * by_turn(result.mean.segment<2>(3));
  result.by_state.block<2, 2>(3, 6) = in_velocity * turned.toRotationMatrix();
  result.by_state.block<2, 1>(6, 5) = dt * by_turn(result.mean.tail<2>());
  result.by_state.block<2, 2>(6, 6) = lasts * turned.toRotationMatrix();
  return result;
}

/// Of place, velocity, and acceleration along one axis (Singer's).
Eigen::Matrix3d lasting_noise(double dt, double sigma, double T) {
  const double u = dt / T, e = std::exp(-u), ee = e * e;
  Eigen::Matrix3d Q;
  Q(0, 0) = 1 - ee + 2 * u + 2 * u * u * u / 3 - 2 * u * u - 4 * u * e;
  Q(0, 1) = Q(1, 0) = (ee + 1 - 2 * e + 2 * u * e - 2 * u + u * u);
  Q(0, 2) = Q(2, 0) = 1 - ee - 2 * u * e;
  Q(1, 1) = 4 * e - 3 - ee + 2 * u;
  Q(1, 2) = Q(2, 1) = (1 - e) * (1 - e);
  Q(2, 2) = 1 - ee;
  const Eigen::Vector3d scale(T * T, T, 1);
  return sigma * sigma * scale.asDiagonal() * Q * scale.asDiagonal();
}

Matrix8d process_noise(double dt, const MotionNoise& noise) {
  Matrix8d result = Matrix8d::Zero();
  const Eigen::Matrix3d lasting =
      lasting_noise(dt, noise.acceleration_sigma, noise.acceleration_time);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int axis = 0; axis < 2; ++axis) result(3 * i + axis, 3 * j + axis) = lasting(i, j);
  result(2, 2) = noise.yaw_acceleration * dt * dt * dt / 3;
  result(2, 5) = result(5, 2) = noise.yaw_acceleration * dt * dt / 2;
  result(5, 5) = noise.yaw_acceleration * dt;
  return result;
}

Eigen::Matrix<double, 8, 3> gain(const TrackState& state, const Eigen::Matrix3d& of_step) {
  return solved<3, 8>(of_step, state.covariance.topRows<3>()).transpose();
}

}  // namespace

double gaussian_density(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance) {
  return std::exp(-0.5 * astray.dot(covariance.inverse() * astray)) /
         (2 * M_PI * std::sqrt(covariance.determinant()));
}

double student_density(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance,
                       double degrees_of_freedom) {
  const double sq = astray.dot(covariance.inverse() * astray);
  return std::exp(-(0.5 * degrees_of_freedom + 1) * std::log1p(sq / degrees_of_freedom)) /
         (2 * M_PI * std::sqrt(covariance.determinant()));
}

TrackState new_track_state(Stamp stamp, const MotionNoise& noise) {
  TrackState state;
  state.stamp = stamp;
  state.covariance.diagonal() << 0, 0, 0, std::pow(noise.unknown_speed_sigma, 2),
      std::pow(noise.unknown_speed_sigma, 2), std::pow(noise.unknown_yaw_rate_sigma, 2),
      std::pow(noise.acceleration_sigma, 2), std::pow(noise.acceleration_sigma, 2);
  return state;
}

TrackState going_along(TrackState state, double heading, const MotionNoise& noise) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(heading).toRotationMatrix();
  const Eigen::Vector2d sigma(noise.unknown_speed_sigma, noise.slow_speed_sigma);
  state.covariance.block<2, 2>(3, 3) = R * sigma.cwiseAbs2().asDiagonal() * R.transpose();
  return state;
}

TrackState predicted(const TrackState& state, Stamp stamp, const MotionNoise& noise) {
  const double dt = seconds_between(state.stamp, stamp);
  if (dt <= 0) return state;
  const Transition to = transition(state.mean, dt, noise);
  return {stamp, to.mean,
          to.by_state * state.covariance * to.by_state.transpose() + process_noise(dt, noise)};
}

TrackState updated(const TrackState& state, const PlanarStep& before, const PlanarStep& after) {
  const auto K = gain(state, before.covariance);
  TrackState result = state;
  result.mean += K * (after.mean - before.mean);
  result.covariance -= K * (before.covariance - after.covariance) * K.transpose();
  return result;
}

TrackState updated(const TrackState& state, const PlanarStep& measured) {
  const Eigen::Vector3d astray = measured.mean - state.mean.head<3>();
  const Eigen::Matrix3d of_state = state.step().covariance;
  const double sq = astray.dot((of_state + measured.covariance).inverse() * astray);
  const double freedom = measured.degrees_of_freedom;
  const double scale = std::max(1., (freedom + sq) / (freedom + 3));
  const auto K = gain(state, of_state + scale * measured.covariance);
  TrackState result = state;
  result.mean += K * astray;
  result.covariance -= K * state.covariance.topRows<3>();
  return result;
}

TrackState smoothed(const TrackState& state, const TrackState& later, const MotionNoise& noise) {
  const double dt = seconds_between(state.stamp, later.stamp);
  if (dt <= 0) return later;
  const TrackState forward = predicted(state, later.stamp, noise);
  const Matrix8d across = transition(state.mean, dt, noise).by_state * state.covariance;
  const Matrix8d K = solved<8, 8>(forward.covariance, across).transpose();
  TrackState result = state;
  result.mean += K * (later.mean - forward.mean);
  result.covariance += K * (later.covariance - forward.covariance) * K.transpose();
  return result;
}

TrackState with_velocity(const TrackState& state, const TrackState& known) {
  const Eigen::Matrix<double, 5, 5> of_velocity = state.covariance.bottomRightCorner<5, 5>();
  const Eigen::Matrix<double, 8, 5> K =
      solved<5, 8>(of_velocity, state.covariance.bottomRows<5>()).transpose();
  TrackState result = state;
  result.mean += K * (known.mean - state.mean).tail<5>();
  result.covariance +=
      K * (known.covariance.bottomRightCorner<5, 5>() - of_velocity) * K.transpose();
  return result;
}

TrackState from_here(TrackState state) {
  state.mean.head<3>().setZero();
  state.covariance.topRows<3>().setZero();
  state.covariance.leftCols<3>().setZero();
  return state;
}

}  // namespace lidar_upsampling
