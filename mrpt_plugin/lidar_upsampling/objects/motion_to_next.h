// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The real scan after the key scan, for those who work on a log on disk.
struct NextScan {
  Stamp stamp;
  Surface surface;                               ///< without the ground, lidar frame at `stamp`
  Pose T_lidar_next_lidar_k = Pose::Identity();  ///< ego-motion
};

/// What an object did from the key scan to the next one.
struct MotionToNext {
  double dt = 0;                                     ///< s
  Pose T_mov = Pose::Identity();                     ///< over ground, in the lidar frame at k
  Eigen::Vector2d step_m = Eigen::Vector2d::Zero();  ///< of the centroid, level
  Eigen::Matrix2d step_covariance = Eigen::Matrix2d::Zero();  ///< m^2
};

/// @brief Registers an object's points on the next scan, at rest and from each guess.
/// @param points_k of the object, lidar frame at k.
/// @param T_mov_guesses its motion over ground until then.
/// @param search whether it is also sought around: where no picture would tell a lookalike.
/// @return none where the next scan shows too little of it.
[[nodiscard]] std::optional<MotionToNext> measure_to_next(
    const std::vector<Eigen::Vector3f>& points_k, Stamp stamp_k, const NextScan& next,
    const std::vector<Pose>& T_mov_guesses, bool search);

/// @brief Of the object moving at all in between: a chi-square, of two degrees of freedom if it
/// did not.
[[nodiscard]] double evidence_of_motion(const MotionToNext& motion);

/// @brief What to expect at an instant in between: on the way at constant velocity, give or take
/// what an acceleration can do between two known ends.
/// @param dt seconds from the key scan on.
[[nodiscard]] MotionPrior expect_on_the_way(const MotionToNext& motion, double dt,
                                            const MotionPriorOptions& options);

}  // namespace lidar_upsampling
