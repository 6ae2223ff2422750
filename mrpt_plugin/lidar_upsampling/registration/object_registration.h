// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct ObjectRegistrationOptions {
  int min_points = 30;
  int max_points = 400;     ///< of the object, evenly thinned
  int choosing_points = 0;  ///< of these, that tell which start leads home; 0: all
  double max_correspondence_m = 1.0;
  double kernel_m = 0.08;         ///< Geman-McClure scale at the end
  double point_weight = 0.05;     ///< of the distance along the surface; 1: point to point
  double tilt_sigma_rad = 0.005;  ///< roll and pitch, against the ego-motion
  double yaw_sigma_rad = 0;       ///< likewise of the turn; 0: free
  double height_sigma_m = 0.02;   ///< vertical step, against the ego-motion
  double search_m = 3.0;  ///< starts are also sought this far around the ego-motion's; 0: not
  double overlap_distance_m = 0.2;  ///< a point is covered if the target has one this near
  double min_overlap = 0.6;
  double max_spread_m = 0.1;  ///< between answers from several starts
  double max_shift_m = 0.2;   ///< of these starts; they need more than half the points' spacing
  int weigh_as = 0;  ///< points, all of them together, against the level, as neighbours err alike;
                     ///< 0: each counts
  int max_iterations = 25;
};

/// For objects of ten points or more from one scan to the next, where neighbours err alike.
[[nodiscard]] ObjectRegistrationOptions options_between_scans();

/// Why a registration is not to be trusted.
enum class RegistrationStatus { reliable, too_few_points, poor_overlap, ambiguous };

[[nodiscard]] const char* to_string(RegistrationStatus status);

struct ObjectRegistration {
  RegistrationStatus status = RegistrationStatus::too_few_points;
  Pose T_target_object = Pose::Identity();
  double overlap = 0;     ///< share of the object's points that are covered
  double residual_m = 0;  ///< root mean squared distance to the target across its surface
  int num_points = 0;     ///< of the object, in the target's sight
  double spread_m = 0;    ///< how far the centroid goes astray from shifted starts that fit as well
  Eigen::Matrix2d slack =
      Eigen::Matrix2d::Zero();  ///< m^2, level covariance told by these starts:
                                ///< huge along surfaces that slide on themselves
};

/// @brief The rigid motion of one object's points onto a whole scan: robust ICP, point to plane
/// with a little point to point, level with the ego-motion; from every guess, from a search around
/// the ego-motion, and again from shifted starts to see whether the answer is unique.
/// @param target the other scan, without ground.
/// @param guesses T_target_object; the first is the ego-motion.
/// @param seen by the target's sensor: what is hidden from it needs no counterpart; null: not
/// known.
/// @throw std::invalid_argument no guess.
[[nodiscard]] ObjectRegistration register_object(const std::vector<Eigen::Vector3f>& points_object,
                                                 const Surface& target,
                                                 const std::vector<Pose>& guesses,
                                                 const ObjectRegistrationOptions& options = {},
                                                 const SeenSpace* seen = nullptr);

}  // namespace lidar_upsampling
