// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/registered_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lidar_upsampling/registration/object_registration.h"

namespace lidar_upsampling {
namespace {

/// The points' mean, and that of those farthest to either side as the sensor sees them: an object
/// that comes out from behind another keeps one end.
std::array<Eigen::Vector3d, 3> landmarks(const std::vector<Eigen::Vector3f>& points,
                                         const Pose& T_k) {
  const Eigen::Isometry3f T = T_k.cast<float>();
  const Eigen::Vector3f mean = T * mean_of(points).cast<float>();
  const Eigen::Vector2f side = Eigen::Vector2f(-mean.y(), mean.x()).normalized();
  std::vector<std::pair<float, int>> across;
  across.reserve(points.size());
  for (const auto& point : points)
    across.emplace_back(side.dot((T * point).head<2>()), static_cast<int>(across.size()));
  const auto share = static_cast<std::ptrdiff_t>(1 + points.size() / 10);
  const auto mean_of_first = [&] {
    std::nth_element(across.begin(), across.begin() + share - 1, across.end());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::ptrdiff_t i = 0; i < share; ++i) sum += (T * points[across[i].second]).cast<double>();
    return Eigen::Vector3d(sum / static_cast<double>(share));
  };
  const Eigen::Vector3d right = mean_of_first();
  for (auto& [place, point] : across) place = -place;
  return {mean.cast<double>(), right, mean_of_first()};
}

/// Level steps over ground that the object may have taken, by its outline.
std::array<Eigen::Vector3d, 3> steps_by_shape(const ObjectScans& scans) {
  const auto before = landmarks(scans.before.points(), scans.T_lidar_k_lidar_before);
  auto step = landmarks(scans.now.points(), Pose::Identity());
  for (std::size_t i = 0; i < step.size(); ++i) {
    step[i] -= before[i];
    if (i > 0) step[i].z() = 0;
  }
  return step;
}

bool can_be_registered(const ObjectScans& scans, const ObjectRegistrationOptions& options) {
  return static_cast<int>(scans.before.points().size()) >= options.min_points &&
         static_cast<int>(scans.now.points().size()) >= options.min_points;
}

/// The object as it is now put on what was seen before.
ObjectRegistration register_backwards(const ObjectScans& scans, std::vector<Pose> guesses,
                                      const ObjectRegistrationOptions& options) {
  for (Pose& guess : guesses) guess = guess.inverse();
  ObjectRegistration result = register_object(scans.now.points(), scans.before, guesses, options,
                                              {scans.seen_before, scans.seen_now});
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
  return register_object(scans.before.points(), scans.now, guesses, options,
                         {scans.seen_now, scans.seen_before});
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
  const double sigma =
      sigma_m(registration.residual_m, registration.num_points / scans.points_per_observation);
  const Eigen::Matrix2d turn = R_rest_lidar_k.topLeftCorner<2, 2>();
  PlanarStep step;
  step.mean << (R_rest_lidar_k * moved).head<2>(),
      std::atan2(T_mov_k.linear()(1, 0), T_mov_k.linear()(0, 0));
  step.covariance.topLeftCorner<2, 2>() =
      sigma * sigma * Eigen::Matrix2d::Identity() + turn * registration.slack * turn.transpose();
  step.covariance(2, 2) = kYaw * kYaw;
  return step;
}

}  // namespace

std::optional<PlanarStep> registered_step(const ObjectScans& scans,
                                          const Eigen::Matrix3d& R_rest_lidar_k) {
  ObjectRegistrationOptions options = options_between_scans();
  options.yaw_sigma_rad = scans.turn_sigma_rad;
  if (!can_be_registered(scans, options)) return {};
  const Pose& T_ego = scans.T_lidar_k_lidar_before;
  std::vector<Pose> guesses{T_ego, T_ego * scans.T_mov_guess};
  const auto steps = steps_by_shape(scans);
  guesses.emplace_back(Eigen::Translation3d(steps[0]) * T_ego);
  ObjectRegistration registration = register_views(scans, guesses, options);
  if (registration.status == RegistrationStatus::poor_overlap) {
    guesses.emplace_back(Eigen::Translation3d(steps[1]) * T_ego);
    guesses.emplace_back(Eigen::Translation3d(steps[2]) * T_ego);
    registration = register_views(scans, guesses, options);
  }
  return step_of(registration, scans, R_rest_lidar_k);
}

}  // namespace lidar_upsampling
