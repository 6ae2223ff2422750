// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/distortion.h"

#include <cmath>
#include <limits>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr double kLargestAngle = 89 * kDegree;

/// A value and its derivative.
struct Dual {
  double value;
  double slope;
};

/// The factor on the radius, and its derivative by the squared radius.
Dual plumb_bob_factor(const CameraModel& model, double sq) {
  const auto& k = model.distortion;
  const double numerator = 1 + sq * (k[0] + sq * (k[1] + sq * k[4]));
  const double denominator = 1 + sq * (k[5] + sq * (k[6] + sq * k[7]));
  const double numerator_slope = k[0] + sq * (2 * k[1] + sq * 3 * k[4]);
  const double denominator_slope = k[5] + sq * (2 * k[6] + sq * 3 * k[7]);
  const double factor = numerator / denominator;
  return {factor, (numerator_slope - factor * denominator_slope) / denominator};
}

/// The distorted radius, and its derivative by the angle from the axis.
Dual kannala_brandt_radius(const CameraModel& model, double angle) {
  const auto& k = model.distortion;
  const double sq = angle * angle;
  return {angle * (1 + sq * (k[0] + sq * (k[1] + sq * (k[4] + sq * k[5])))),
          1 + sq * (3 * k[0] + sq * (5 * k[1] + sq * (7 * k[4] + sq * 9 * k[5])))};
}

/// Does the distorted radius still grow at this angle? A rational model ends at its pole, too.
bool grows_at(const CameraModel& model, double angle) {
  if (model.distortion_model == DistortionModel::kannala_brandt) {
    return kannala_brandt_radius(model, angle).slope > 0;
  }
  const double sq = std::tan(angle) * std::tan(angle);
  const auto& k = model.distortion;
  if (1 + sq * (k[5] + sq * (k[6] + sq * k[7])) <= 0) return false;
  const Dual factor = plumb_bob_factor(model, sq);
  return factor.value + 2 * sq * factor.slope > 0;
}

Distorted distort_plumb_bob(const CameraModel& model, const Eigen::Vector2d& normalised) {
  const double x = normalised.x();
  const double y = normalised.y();
  const double sq = x * x + y * y;
  const auto [factor, slope] = plumb_bob_factor(model, sq);
  const double p1 = model.distortion[2];
  const double p2 = model.distortion[3];
  Distorted result;
  result.point << x * factor + 2 * p1 * x * y + p2 * (sq + 2 * x * x),
      y * factor + p1 * (sq + 2 * y * y) + 2 * p2 * x * y;
  const double cross = 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y;
  result.jacobian << factor + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x, cross, cross,
      factor + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x;
  return result;
}

Distorted distort_kannala_brandt(const CameraModel& model, const Eigen::Vector2d& normalised) {
  const double radius = normalised.norm();
  if (radius < 1e-9) return {normalised, Eigen::Matrix2d::Identity()};
  const Eigen::Vector2d direction = normalised / radius;
  const auto [distorted, slope_by_angle] = kannala_brandt_radius(model, std::atan(radius));
  const double slope = slope_by_angle / (1 + radius * radius);
  const Eigen::Matrix2d radial = direction * direction.transpose();
  return {distorted * direction,
          slope * radial + distorted / radius * (Eigen::Matrix2d::Identity() - radial)};
}

std::optional<Eigen::Vector2d> undistort_kannala_brandt(const CameraModel& model,
                                                        const Eigen::Vector2d& distorted,
                                                        double max_radius) {
  const double wanted = distorted.norm();
  if (wanted < 1e-12) return distorted;
  double low = 0;
  double high = std::atan(max_radius);
  if (kannala_brandt_radius(model, high).value < wanted) return std::nullopt;
  double angle = std::min(wanted, high);
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = kannala_brandt_radius(model, angle);
    (value < wanted ? low : high) = angle;
    double next = angle - (value - wanted) / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const bool settled = std::abs(next - angle) < 1e-14;
    angle = next;
    if (settled) break;
  }
  return distorted * (std::tan(angle) / wanted);
}

}  // namespace

Distorted distort(const CameraModel& model, const Eigen::Vector2d& normalised) {
  switch (model.distortion_model) {
    case DistortionModel::plumb_bob:
      return distort_plumb_bob(model, normalised);
    case DistortionModel::kannala_brandt:
      return distort_kannala_brandt(model, normalised);
    case DistortionModel::none:
      break;
  }
  return {normalised, Eigen::Matrix2d::Identity()};
}

double valid_radius(const CameraModel& model) {
  if (model.distortion_model == DistortionModel::none)
    return std::numeric_limits<double>::infinity();
  constexpr int kNumSteps = 128;
  const auto angle_at = [](int step) { return kLargestAngle * step / kNumSteps; };
  int step = 1;
  while (step <= kNumSteps && grows_at(model, angle_at(step))) ++step;
  if (step > kNumSteps) {
    return model.distortion_model == DistortionModel::plumb_bob
               ? std::numeric_limits<double>::infinity()
               : std::tan(kLargestAngle);
  }
  double low = angle_at(step - 1);
  double high = angle_at(step);
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (grows_at(model, middle) ? low : high) = middle;
  }
  return std::tan(low);
}

std::optional<Eigen::Vector2d> undistort_normalised(const CameraModel& model,
                                                    const Eigen::Vector2d& distorted,
                                                    double max_radius) {
  if (model.distortion_model == DistortionModel::none) return distorted;
  if (model.distortion_model == DistortionModel::kannala_brandt) {
    return undistort_kannala_brandt(model, distorted, max_radius);
  }
  Eigen::Vector2d normalised = distorted;
  if (normalised.norm() > 0.9 * max_radius) normalised *= 0.9 * max_radius / normalised.norm();
  double error = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 50; ++i) {
    const Distorted at = distort(model, normalised);
    const Eigen::Vector2d difference = distorted - at.point;
    error = difference.norm();
    if (error < 1e-13) break;
    Eigen::Vector2d step = at.jacobian.inverse() * difference;
    // Near the fold the Jacobian vanishes and a full step would leave the valid disc.
    for (int halving = 0; halving < 30 && !((normalised + step).norm() < max_radius); ++halving) {
      step *= 0.5;
    }
    normalised += step;
  }
  if (!(error < 1e-9) || !(normalised.norm() < max_radius)) return std::nullopt;
  return normalised;
}

}  // namespace lidar_upsampling
