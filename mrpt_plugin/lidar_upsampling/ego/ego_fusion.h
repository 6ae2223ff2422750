// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>

#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/se3.h"

/// Given poses, registered scans and followed points joined to one ego-motion. Steps are
/// T_lidar_t_lidar_k; covariances are those of a left increment (w, t), rad and m, in the lidar
/// frame at t: T = exp(w, t) * T_estimated (Barfoot, State Estimation for Robotics, 7.3.1).
namespace lidar_upsampling {

/// @brief The precision-weighted mean of two independent estimates of one step (Barfoot, 7.3.4; to
/// first order in their difference). A direction in which one is exact is followed to the digit; if
/// both are exact, `a` is.
[[nodiscard]] EgoStep fused(const EgoStep& a, const EgoStep& b);

/// @brief A registration as a step with a covariance to believe: neighbouring points err alike, and
/// what moves along with the sensor drags it along, the more the less of what stands holds.
[[nodiscard]] EgoStep step_of(const Registration& registration);

/// What steps of given poses have been wrong by lately, as registered scans show it.
struct PoseNoise {
  struct Step {
    Twist sq_difference;  ///< rad^2, m^2: of poses and registration
    Twist variance;       ///< of that, the registration's share
  };
  std::deque<Step> steps;  ///< the last ones, oldest first
};

/// @brief One more step.
/// @param given, registered between the same two scans.
void note_step(PoseNoise& noise, const EgoStep& given, const EgoStep& registered);

/// @brief Variances, rad^2 and m^2, that steps of a source usually have: what holds until scans
/// show it.
/// @param velocity m/s, of the lidar: clocks are not set to the millisecond.
[[nodiscard]] Twist usual_noise(EgoSource source, const Eigen::Vector3d& velocity);

/// @brief Variances, rad^2 and m^2, that steps of smoothed fixes have at least, however well they
/// have fitted a straight road: smoothing cuts corners.
/// @param dt s, of the step.
[[nodiscard]] Twist smoothing_noise(double dt);

/// @brief Variances per axis, rad^2 and m^2, of a step between two of the given poses, however far
/// apart they lie: the most likely ones, truncated at zero. Zero are those of poses that are exact
/// as far as scans can tell, which one axis alone does not gainsay. No axis counts as better than
/// the three of its kind together, as registration is worst where vehicles go.
/// @param usual counts as one step more.
[[nodiscard]] Twist likely_noise(const PoseNoise& noise, const Twist& usual);

}  // namespace lidar_upsampling
