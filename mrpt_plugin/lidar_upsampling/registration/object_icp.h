// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/registration/object_fit.h"

namespace lidar_upsampling {

/// Where an object comes to lie on a target.
struct Fitted {
  Pose T = Pose::Identity();  ///< T_target_object
  double score = kScoreCut;
  double rank = kScoreCut;  ///< the score, with what an unexpected place adds
};

/// @brief ICP from one guess: point to plane with a little point to point, Geman-McClure weights
/// whose scale shrinks to the options', softly level with the ego-motion.
/// @param stop a step this short ends the search, m and rad.
[[nodiscard]] Fitted converge(const ObjectFit& problem, const Pose& guess, double stop = 2e-4);

[[nodiscard]] Pose shifted_by(const Pose& T, double x, double y);

}  // namespace lidar_upsampling
