// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/sensor_errors.h"

#include <algorithm>
#include <cmath>

#include "simulator/noise.h"

namespace lidar_upsampling::sim {

namespace {

std::uint32_t seed_of(const CameraSpec& spec, std::uint32_t seed) {
  std::uint32_t own = hash(seed, 0xca11b);
  for (const char letter : spec.camera.label) own = hash(own, static_cast<unsigned char>(letter));
  return own;
}

Eigen::Vector3d random_direction(std::uint32_t seed) {
  return Eigen::Vector3d(gaussian(seed, 1), gaussian(seed, 2), gaussian(seed, 3)).normalized();
}

// Of unit variance at every instant: neighbouring draws, a second apart, fade into each other.
double drift(std::uint32_t seed, double t) {
  constexpr double kSpacing = 1, kBeforeStart = 1000;
  const double at = (t + kBeforeStart) / kSpacing;
  const auto i = static_cast<std::uint32_t>(at);
  const double angle = 0.5 * M_PI * (at - i);
  return std::cos(angle) * gaussian(seed, i) + std::sin(angle) * gaussian(seed, i + 1);
}

Eigen::Vector3d drift_and_noise(std::uint32_t seed, double t, std::uint32_t ticks) {
  constexpr double kDriftVariance = 0.9;
  Eigen::Vector3d error;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t own = hash(seed, axis);
    error[axis] = std::sqrt(kDriftVariance) * drift(own, t) +
                  std::sqrt(1 - kDriftVariance) * gaussian(own + 1, ticks);
  }
  return error;
}

}  // namespace

Pose told_mounting(const CameraSpec& spec, std::uint32_t seed) {
  if (spec.calibration_error_rad == 0 && spec.calibration_error_m == 0) {
    return spec.camera.T_vehicle_camera;
  }
  const std::uint32_t own = seed_of(spec, seed);
  Pose T_true_told = Pose::Identity();
  T_true_told.linear() =
      Eigen::AngleAxisd(spec.calibration_error_rad, random_direction(hash(own, 1)))
          .toRotationMatrix();
  T_true_told.translation() = spec.calibration_error_m * random_direction(hash(own, 2));
  return spec.camera.T_vehicle_camera * T_true_told;
}

Stamp told_stamp(const CameraSpec& spec, Stamp stamp, double duration_s, std::uint32_t seed) {
  if (spec.time_jitter_s == 0) return stamp;
  const auto ticks = static_cast<std::uint32_t>((stamp - start_stamp()).count());
  const double sigmas = std::clamp(gaussian(hash(seed_of(spec, seed), 3), ticks), -3., 3.);
  const Stamp end = std::max(stamp, shifted(start_stamp(), duration_s));
  return std::clamp(shifted(stamp, spec.time_jitter_s * sigmas), start_stamp(), end);
}

Pose told_ego_pose(const World& world, const EgoPoseSpec& spec, Stamp stamp, std::uint32_t seed) {
  const double t = time_of(stamp) - spec.lag_s;
  Pose T = world.T_world_vehicle(t);
  if (spec.noise_m == 0 && spec.noise_rad == 0) return T;
  const auto ticks = static_cast<std::uint32_t>((stamp - start_stamp()).count());
  T.translation() += spec.noise_m * drift_and_noise(hash(seed, 0xe601), t, ticks);
  const Eigen::Vector3d turn = spec.noise_rad * drift_and_noise(hash(seed, 0xe602), t, ticks);
  if (turn.norm() > 0) T.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return T;
}

}  // namespace lidar_upsampling::sim
