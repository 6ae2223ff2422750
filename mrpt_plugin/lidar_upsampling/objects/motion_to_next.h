// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/objects/travel.h"
#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The real scan after the key scan, for those who work on a log on disk.
struct NextScan {
  Stamp stamp;
  Surface surface;                               ///< without the ground, lidar frame at `stamp`
  Pose T_lidar_next_lidar_k = Pose::Identity();  ///< ego-motion
  SeenSpace seen;                                ///< lidar frame at `stamp`
  const SeenSpace* seen_k = nullptr;             ///< by the key scan; null: not asked
  double vertical_step_deg = 0;                  ///< between rings
};

/// An object of the key scan that is looked for in the next one.
struct SoughtObject {
  std::vector<Eigen::Vector3f> points;  ///< lidar frame at k
  Stamp stamp;                          ///< of their own measurement
  std::vector<Pose> T_mov_guesses;      ///< its motion over ground until the next scan
  LevelGaussian expected_step;          ///< of its centroid over ground until then
  bool search = false;   ///< whether also around: where no picture would tell a lookalike
  bool is_whole = true;  ///< whether it is taken to end where nothing tells of more
};

/// What an object did from the key scan to the next one.
struct MotionToNext {
  double dt = 0;                                         ///< s
  Pose T_mov = Pose::Identity();                         ///< over ground, in the lidar frame at k
  Eigen::Vector3d centroid_k = Eigen::Vector3d::Zero();  ///< lidar frame at k
  LevelGaussian step;                                    ///< of the centroid
};

/// @brief Registers an object's points on the next scan, at rest and from each guess.
/// @return none where the next scan shows too little of it, or only far from where it is expected
/// or where something stood before, while it seems to be at its old place still: a lookalike.
[[nodiscard]] std::optional<MotionToNext> measure_to_next(const SoughtObject& object,
                                                          const NextScan& next);

/// @brief Of the object moving at all until the next scan: a chi-square that is as significant as
/// one of six degrees of freedom, as the picture's.
/// @param alone where there is no picture that would speak for parked: one in twenty then is
/// significant, not one in a hundred.
[[nodiscard]] double evidence_of_motion(const Travel& travel, double dt, bool alone);

/// @brief What to expect at an instant in between: where its travel leads, turned as measured.
/// @param travel with the step to the next scan.
/// @param dt seconds from the key scan on.
[[nodiscard]] MotionPrior expect_on_the_way(const MotionToNext& motion, const Travel& travel,
                                            double dt, const MotionPriorOptions& options);

}  // namespace lidar_upsampling
