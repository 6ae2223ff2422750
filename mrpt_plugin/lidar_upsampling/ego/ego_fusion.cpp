// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/ego_fusion.h"

#include <algorithm>

#include "lidar_upsampling/decompositions.h"

namespace lidar_upsampling {
namespace {

// As many steps as a vehicle takes to change its ways: two seconds of a 10 Hz scanner.
constexpr std::size_t kWindow = 20;
// Points of one wall share its roughness and its normals' errors. In simulated streets registration
// is wrong by up to twice what independent points would say (in pitch): three times is on the safe
// side, so that exact poses are not taken for noisy ones.
constexpr double kPointsPerObservation = 9;
// m, and a share of the points: by what a queue that moves along, and rings on what is level, pull
// registration along the way. In simulated queues with exact poses it is 2 cm where 3 % of the
// points hold, 5 cm where 2 % do, 12 cm where 1 % does. It may be all of the way: as much as
// registration tells less than was expected.
constexpr double kDrag_m = 0.02, kEnoughHold = 0.05;

double squared(double value) { return value * value; }

// Of greatest likelihood, for differences ~ N(0, V + their registration's variance): the root of
// sum (d^2 - r - V) / (V + r)^2, by iteration.
double likely_variance(const PoseNoise& noise, const Twist& usual, int first_axis, int num_axes) {
  constexpr int kIterations = 50;
  const double expected = usual.segment(first_axis, num_axes).mean();
  double variance = expected;
  for (const auto& step : noise.steps)
    variance = std::max(variance, step.sq_difference.segment(first_axis, num_axes).maxCoeff());
  for (int i = 0; i < kIterations; ++i) {
    double weights = num_axes / squared(std::max(expected, variance));
    double sum = weights * expected;
    for (const auto& step : noise.steps)
      for (int axis = first_axis; axis < first_axis + num_axes; ++axis) {
        const double weight = 1 / squared(variance + step.variance[axis]);
        weights += weight;
        sum += weight * (step.sq_difference[axis] - step.variance[axis]);
      }
    variance = std::max(0., sum / weights);
  }
  return variance;
}

}  // namespace

EgoStep fused(const EgoStep& a, const EgoStep& b) {
  EgoStep result = a;
  if (a.covariance.isZero(0)) return result;
  // A (A + B)^-1: both are symmetric.
  const Matrix6d gain = solved_in_range(a.covariance + b.covariance, a.covariance).transpose();
  const Matrix6d rest = Matrix6d::Identity() - gain;
  const Twist difference = log_se3(b.T_to_from * a.T_to_from.inverse());
  result.T_to_from = renormalized(exp_se3(Twist(gain * difference)) * a.T_to_from);
  result.covariance =
      rest * a.covariance * rest.transpose() + gain * b.covariance * gain.transpose();
  return result;
}

EgoStep step_of(const Registration& registration) {
  EgoStep step;
  step.T_to_from = registration.T_target_source;
  step.covariance = kPointsPerObservation * registration.covariance;
  const Eigen::Vector3d& way = registration.way;
  double drag_m = kDrag_m;
  if (registration.hold < kEnoughHold) {
    const double lost_m = way.norm() - registration.T_target_source.translation().norm();
    drag_m = std::max(kDrag_m * kEnoughHold / std::max(1e-9, registration.hold), lost_m);
  }
  const Eigen::Vector3d drag = way * std::min(1., drag_m / std::max(1e-9, way.norm()));
  step.covariance.bottomRightCorner<3, 3>() += drag * drag.transpose();
  return step;
}

void note_step(PoseNoise& noise, const EgoStep& given, const EgoStep& registered) {
  const Twist difference = log_se3(given.T_to_from * registered.T_to_from.inverse());
  noise.steps.push_back({difference.cwiseAbs2(), registered.covariance.diagonal()});
  if (noise.steps.size() > kWindow) noise.steps.pop_front();
}

Twist usual_noise(EgoSource source, const Eigen::Vector3d& velocity) {
  constexpr double kClock_s = 0.01;                     // of receivers without a common trigger
  double turn_rad = 0.0005, translation_m = 0.02;       // RTK and IMU: as their data sheets say
  if (source == EgoSource::odometry) turn_rad = 0.005;  // wheels slip
  if (source == EgoSource::gnss) turn_rad = 0.02, translation_m = 0.1;  // from fix to fix
  Twist variance;
  variance.head<3>().setConstant(squared(turn_rad));
  variance.tail<3>() =
      (kClock_s * velocity).cwiseAbs2() + Eigen::Vector3d::Constant(squared(translation_m));
  return variance;
}

Twist smoothing_noise(double dt) {
  constexpr double kTurn_rad_s = 0.05;  // of a turn that begins within the half second of a fit
  constexpr double kStep_m = 0.001;     // it is the heading that is cut, and not the place
  Twist variance;
  variance.head<3>().setConstant(squared(kTurn_rad_s * dt));
  variance.tail<3>().setConstant(squared(kStep_m));
  return variance;
}

Twist likely_noise(const PoseNoise& noise, const Twist& usual) {
  if (noise.steps.empty()) return usual;
  Twist alone, together;
  for (int axis = 0; axis < 6; ++axis) alone[axis] = likely_variance(noise, usual, axis, 1);
  for (const int kind : {0, 3})
    together.segment<3>(kind).setConstant(likely_variance(noise, usual, kind, 3));
  // Registration has a weak axis: the way ahead in a queue that moves along, pitch on few rings.
  const bool are_exact = (alone.array() > 0).count() < 2 || together.isZero(0);
  return are_exact ? Twist(Twist::Zero()) : Twist(together.cwiseMax(alone));
}

}  // namespace lidar_upsampling
