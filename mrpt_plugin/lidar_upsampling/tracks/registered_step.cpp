// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/registered_step.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/registration/object_registration.h"

namespace lidar_upsampling {
namespace {

bool can_be_registered(const ObjectScans& scans, const ObjectRegistrationOptions& options) {
  return static_cast<int>(scans.before.points().size()) >= options.min_points &&
         static_cast<int>(scans.now.points().size()) >= options.min_points;
}

/// The object as it is now put on what was seen before.
ObjectRegistration register_backwards(const ObjectScans& scans, std::vector<Pose> guesses,
                                      const ObjectRegistrationOptions& options) {
  for (Pose& guess : guesses) guess = guess.inverse();
  ObjectRegistration result =
      register_object(scans.now.points(), scans.before, guesses, options, scans.seen_before);
  result.T_target_object = result.T_target_object.inverse();
  const Eigen::Matrix2d turn = result.T_target_object.linear().topLeftCorner<2, 2>();
  result.slack = turn * result.slack * turn.transpose();
  return result;
}

/// The view with fewer points is likelier to be a part of the other one than the reverse.
ObjectRegistration register_views(const ObjectScans& scans, const std::vector<Pose>& guesses,
                                  const ObjectRegistrationOptions& options) {
  if (scans.before.points().size() > scans.now.points().size())
    return register_backwards(scans, guesses, options);
  return register_object(scans.before.points(), scans.now, guesses, options, scans.seen_now);
}

/// How well a registration tells a step. What scatters about surfaces averages out; what lies off
/// them (leaves, gaps between sparse rings) draws all points one way.
double sigma_m(double residual_m, double num_observations) {
  constexpr double kFinest_m = 0.005;  // straightening of the scans, edges between beams
  constexpr double kGood_m = 0.03;     // left between good matches by the sensors' own noise
  const double off = std::sqrt(std::max(0., residual_m * residual_m - kGood_m * kGood_m));
  return std::hypot(kFinest_m, residual_m / std::sqrt(num_observations), 0.5 * off);
}

std::optional<PlanarStep> step_of(const ObjectRegistration& registration, const ObjectScans& scans,
                                  const Eigen::Matrix3d& R_rest_lidar_k) {
  constexpr double kMaxRise_m = 0.1;  // between two scans: road users stay on the road
  constexpr double kYaw = 0.05;       // rad: 10 cm at the ends of a car
  if (registration.status != RegistrationStatus::reliable &&
      registration.status != RegistrationStatus::ambiguous)
    return {};
  // Over ground, in the axes of the lidar frame at k.
  const Pose T_mov_k = registration.T_target_object * scans.T_lidar_k_lidar_before.inverse();
  const Eigen::Vector3d centroid = mean_of(scans.now.points());
  const Eigen::Vector3d moved = centroid - T_mov_k.inverse() * centroid;
  if (std::abs(moved.z()) > kMaxRise_m) return {};
  const double num_observations = registration.num_points / scans.points_per_observation;
  const double sigma = sigma_m(registration.residual_m, num_observations);
  const Eigen::Matrix2d turn = R_rest_lidar_k.topLeftCorner<2, 2>();
  PlanarStep step;
  step.mean << (R_rest_lidar_k * moved).head<2>(),
      std::atan2(T_mov_k.linear()(1, 0), T_mov_k.linear()(0, 0));
  step.covariance.topLeftCorner<2, 2>() =
      sigma * sigma * Eigen::Matrix2d::Identity() + turn * registration.slack * turn.transpose();
  step.covariance(2, 2) = kYaw * kYaw;
  step.degrees_of_freedom = std::max(1., 2 * num_observations - 3);  // level; less what is told
  return step;
}

}  // namespace

std::optional<PlanarStep> registered_step(const ObjectScans& scans,
                                          const Eigen::Matrix3d& R_rest_lidar_k) {
  ObjectRegistrationOptions options = options_between_scans();
  options.yaw_sigma_rad = scans.turn_sigma_rad;
  if (!can_be_registered(scans, options)) return {};
  const Pose& T_ego = scans.T_lidar_k_lidar_before;
  const Eigen::Vector3d by_centroid =
      mean_of(scans.now.points()) - T_ego * mean_of(scans.before.points());
  const std::vector<Pose> guesses{T_ego, T_ego * scans.T_mov_guess,
                                  Eigen::Translation3d(by_centroid) * T_ego};
  return step_of(register_views(scans, guesses, options), scans, R_rest_lidar_k);
}

}  // namespace lidar_upsampling
