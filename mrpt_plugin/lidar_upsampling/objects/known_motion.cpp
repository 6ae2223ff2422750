// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/known_motion.h"

#include <cmath>

#include "lidar_upsampling/registration/object_registration.h"

namespace lidar_upsampling {
namespace {

constexpr double kRadian = M_PI / 180;

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point.cast<double>();
  return sum / static_cast<double>(points.size());
}

}  // namespace

double evidence_of_motion(const KnownMotion& known) {
  constexpr double kFinest = 0.1;  // m/s
  return std::pow(known.velocity_at_rest.norm() / std::max(known.velocity_sigma, kFinest), 2);
}

Twist rate_over_ground(const KnownMotion& known, const Eigen::Matrix3d& R_lidar_k_rest,
                       const Eigen::Vector3d& centroid) {
  const Eigen::Vector3d omega(0, 0, known.yaw_rate);
  Twist rate;
  rate << omega, R_lidar_k_rest * known.velocity_at_rest - omega.cross(centroid);
  return rate;
}

MotionPrior expect_motion(const std::optional<KnownMotion>& known, Stamp key_stamp,
                          const Eigen::Matrix3d& R_lidar_k_rest, const Eigen::Vector3d& centroid,
                          double dt, const MotionPriorOptions& options) {
  MotionPrior prior;
  prior.height_sigma_m = options.height_sigma_m + options.height_rate_sigma * dt;
  prior.tilt_sigma = kRadian * (options.tilt_sigma_deg + options.tilt_rate_sigma_deg * dt);
  prior.yaw_sigma = options.yaw_rate_sigma * dt + kRadian * options.tilt_sigma_deg;
  if (!known) {
    prior.position_sigma_m = options.unknown_speed_sigma * dt;
    prior.yaw_sigma += 3 * options.yaw_rate_sigma * dt;
    return prior;
  }
  prior.T_mov = exp_se3(Twist(rate_over_ground(*known, R_lidar_k_rest, centroid) * dt));
  const double age = seconds_between(known->stamp, key_stamp) + 0.5 * dt;
  const double speed_sigma = std::hypot(known->velocity_sigma, options.acceleration_sigma * age);
  prior.position_sigma_m = speed_sigma * dt + 0.005;
  return prior;
}

PosePrior pose_prior(const MotionPrior& prior, const Pose& T_camera_t_lidar_k_ego,
                     const Eigen::Vector3d& centroid) {
  PosePrior result;
  result.T_mean = T_camera_t_lidar_k_ego * prior.T_mov;
  // An increment (w, t) of the camera frame turns the object by w and moves its centroid c by
  // t + w x c; both are judged in the lidar frame's axes.
  const Eigen::Matrix3d R_lidar_camera = T_camera_t_lidar_k_ego.linear().transpose();
  const Eigen::Vector3d c = result.T_mean * centroid;
  const Eigen::Vector3d turn(1 / prior.tilt_sigma, 1 / prior.tilt_sigma, 1 / prior.yaw_sigma);
  const Eigen::Vector3d step(1 / prior.position_sigma_m, 1 / prior.position_sigma_m,
                             1 / prior.height_sigma_m);
  result.sqrt_information.topLeftCorner<3, 3>() = turn.asDiagonal() * R_lidar_camera;
  result.sqrt_information.bottomLeftCorner<3, 3>() = step.asDiagonal() * R_lidar_camera * skew(-c);
  result.sqrt_information.bottomRightCorner<3, 3>() = step.asDiagonal() * R_lidar_camera;
  return result;
}

std::optional<KnownMotion> measure_between_scans(const ObjectScans& scans, Stamp stamp_k,
                                                 const Eigen::Matrix3d& R_rest_lidar_k) {
  ObjectRegistrationOptions options;
  options.min_points = 20;
  options.max_points = 120;
  options.max_iterations = 15;
  options.search_m = 0;
  if (static_cast<int>(scans.before.size()) < options.min_points ||
      static_cast<int>(scans.now.size()) < options.min_points || scans.dt <= 0)
    return {};
  const Surface target = make_surface(scans.now);
  const Pose& T_ego = scans.T_lidar_k_lidar_before;
  const Eigen::Vector3d centroid = T_ego * mean_of(scans.before);
  const Pose T_by_centroids = Eigen::Translation3d(mean_of(scans.now) - centroid) * T_ego;
  const ObjectRegistration registration = register_object(
      scans.before, target, {T_ego, T_ego * scans.T_mov_guess, T_by_centroids}, options);
  if (registration.status != RegistrationStatus::reliable) return {};

  // Over ground, in the axes of the lidar frame at k.
  const Pose T_mov_k = registration.T_target_object * T_ego.inverse();
  KnownMotion known;
  known.stamp = shifted(stamp_k, -0.5 * scans.dt);
  known.velocity_at_rest =
      R_rest_lidar_k * Eigen::Vector3d((T_mov_k * centroid - centroid) / scans.dt);
  known.yaw_rate = std::atan2(T_mov_k.linear()(1, 0), T_mov_k.linear()(0, 0)) / scans.dt;
  constexpr double kRegistrationSigma_m = 0.03;
  known.velocity_sigma = std::hypot(kRegistrationSigma_m, registration.spread_m) / scans.dt;
  return known;
}

}  // namespace lidar_upsampling
