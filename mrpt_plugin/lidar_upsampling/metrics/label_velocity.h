// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Where somebody's label puts an object at an instant; single ones are off by 5 to 10 cm.
struct LabelledPosition {
  Stamp stamp;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world, m
};

struct FittedVelocity {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< over ground, m/s
  int num_labels = 0;                                  ///< that it was fitted to
};

/// How far from an instant labels count, and how many must be there.
struct LabelWindow {
  double half_width_s = 0.35;
  int min_labels = 5;
};

/// @brief The window for a log: 0.35 s to either side, three labels at 10 Hz, or 1.5 intervals
/// where labels are rarer; five labels, or one less than the log ever has in such a window.
/// @param all_label_stamps of all objects' labels, in any order.
[[nodiscard]] LabelWindow label_window(std::vector<Stamp> all_label_stamps);

/// @brief The slope of the straight line through the labels about an instant, by least squares: two
/// labels 0.1 s apart would tell a parked car to drive at 1 m/s, seven tell it to 0.2 m/s. Free of
/// bias under a constant acceleration where the labels lie evenly to both sides.
/// @param track one object's labels, in any order.
/// @return none where there are fewer labels than the window asks for, or all at one instant.
[[nodiscard]] std::optional<FittedVelocity> fit_velocity(const std::vector<LabelledPosition>& track,
                                                         Stamp stamp, const LabelWindow& window);

}  // namespace lidar_upsampling
