// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/registration/object_registration.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// An object to be fitted to a target, and by what it is judged.
struct ObjectFit {
  const std::vector<Eigen::Vector3f>& points;
  const Surface& target;
  const Pose& T_level;  ///< the ego-motion
  const ObjectRegistrationOptions& options;
  Eigen::Vector3d centroid;  ///< of the points
  const SeenSpace* seen;     ///< by the target's sensor; null: not known
};

/// Farther matches, m, are all as bad.
constexpr double kScoreCut = 0.5;

[[nodiscard]] Sight sight_in(const ObjectFit& fit, const Eigen::Vector3f& place);

/// @brief Root mean squared distance to the nearest target point, m. What is hidden counts as if
/// just covered: neither for nor much against a place. A place of which too little is visible is as
/// bad as can be.
/// @param stride every so many points are asked.
[[nodiscard]] double score_of(const ObjectFit& fit, const Pose& T_target_object, int stride = 1);

/// What is left between an object and its target.
struct SurfaceResidual {
  double rms_m = 0;    ///< of the visible points' distances across the target's surface
  int num_points = 0;  ///< visible ones
};

[[nodiscard]] SurfaceResidual residual_of(const ObjectFit& fit, const Pose& T_target_object);

/// How the target's points lie under an object.
struct Sampling {
  double spacing_m = 0;  ///< median distance to the next one
  Eigen::Matrix2d pull =
      Eigen::Matrix2d::Zero();  ///< level: of a common shift of all matches along their surfaces,
                                ///< what the answer follows
  Eigen::Vector2d loosest = Eigen::Vector2d::UnitX();  ///< level: the way it is held least
};

[[nodiscard]] Sampling sampling_under(const ObjectFit& fit, const Pose& T_target_object);

/// @brief The share of the visible points that are covered; 0 where too few are visible.
[[nodiscard]] double overlap_of(const ObjectFit& fit, const Pose& T_target_object);

/// Where an object comes to lie on a target.
struct Fitted {
  Pose T = Pose::Identity();  ///< T_target_object
  double score = kScoreCut;
};

/// @brief ICP from one guess: point to plane with a little point to point, Geman-McClure weights
/// whose scale shrinks to the options', softly level with the ego-motion.
/// @param stop a step this short ends the search, m and rad.
/// @param widening of that scale at first; 1: the guess is good.
[[nodiscard]] Fitted converge(const ObjectFit& problem, const Pose& guess, double stop,
                              double widening = 4);

}  // namespace lidar_upsampling
