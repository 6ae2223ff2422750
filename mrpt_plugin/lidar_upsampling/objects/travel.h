// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A level vector, as a Gaussian.
struct LevelGaussian {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// @brief The travel from the key scan on, in the axes of the lidar frame then.
/// @param known none for an object seen for the first time.
/// @param R_lidar_k_rest from the frame at rest, in which `known` is.
[[nodiscard]] Travel expect_travel(const std::optional<KnownMotion>& known, Stamp key_stamp,
                                   const Eigen::Matrix3d& R_lidar_k_rest,
                                   const MotionPriorOptions& options);

/// @brief What a step measured from the key scan on says of it (a Kalman update).
/// @param dt seconds from the key scan to the step's end.
[[nodiscard]] Travel having_seen(const Travel& travel, const LevelGaussian& step, double dt);

/// @brief The same travel, told from an instant `dt` seconds later on. Accelerations do not last
/// (Singer's model: they fade, and others come, within a second).
[[nodiscard]] Travel later(const Travel& travel, double dt, const MotionPriorOptions& options);

[[nodiscard]] Travel turned(const Travel& travel, const Eigen::Matrix3d& R);

/// @brief m, from the key scan on, `dt` seconds later.
[[nodiscard]] LevelGaussian step_at(const Travel& travel, double dt);

/// @brief m/s, `dt` seconds after the key scan.
[[nodiscard]] LevelGaussian velocity_at(const Travel& travel, double dt);

/// @brief Squared distance of two independent Gaussians in standard deviations: a chi-square of two
/// degrees of freedom if their true values are the same.
[[nodiscard]] double disagreement(const LevelGaussian& a, const LevelGaussian& b);

}  // namespace lidar_upsampling
