// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/registration/object_icp.h"

namespace lidar_upsampling {

/// How far an object may lie from where it was fitted, for all that its points and the target tell.
struct Ambiguity {
  double spread_m = 0;                              ///< how far shifted starts go astray
  Eigen::Matrix2d slack = Eigen::Matrix2d::Zero();  ///< m^2, level covariance told by them
};

/// @brief Fits the object again from starts around the answer. One that comes back part of the way
/// speaks of a weak pull there, one that stays of none, and what has gone out of sight cannot come
/// back. Points lock into one another's pattern: starts are more than half a step of it away, and
/// within a step they may lie anyhow.
[[nodiscard]] Ambiguity ambiguity_of(const ObjectFit& problem, const Fitted& best);

}  // namespace lidar_upsampling
