// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/motion_to_next.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/registration/object_registration.h"

namespace lidar_upsampling {
namespace {

constexpr double kRegistrationSigma_m = 0.02;
constexpr double kSearch_m = 2;  // around rest, for objects of which nothing is known

ObjectRegistrationOptions registration_options() {
  ObjectRegistrationOptions options;
  options.min_points = 10;
  options.max_points = 200;
  options.max_iterations = 20;
  return options;
}

}  // namespace

std::optional<MotionToNext> measure_to_next(const std::vector<Eigen::Vector3f>& points_k,
                                            Stamp stamp_k, const NextScan& next,
                                            const std::vector<Pose>& T_mov_guesses, bool search) {
  std::vector<Pose> guesses{next.T_lidar_next_lidar_k};
  for (const Pose& T_mov : T_mov_guesses) guesses.push_back(next.T_lidar_next_lidar_k * T_mov);
  ObjectRegistrationOptions options = registration_options();
  options.search_m = search ? kSearch_m : 0;
  const ObjectRegistration found = register_object(points_k, next.surface, guesses, options);
  if (found.status != RegistrationStatus::reliable && found.status != RegistrationStatus::ambiguous)
    return {};

  MotionToNext motion;
  motion.dt = seconds_between(stamp_k, next.stamp);
  motion.T_mov = next.T_lidar_next_lidar_k.inverse() * found.T_target_object;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points_k) centroid += point.cast<double>();
  centroid /= static_cast<double>(points_k.size());
  motion.step_m = (motion.T_mov * centroid - centroid).head<2>();
  const double sigma = std::hypot(kRegistrationSigma_m, 0.5 * found.residual_m);
  const Eigen::Matrix2d turn = next.T_lidar_next_lidar_k.linear().transpose().topLeftCorner<2, 2>();
  motion.step_covariance =
      sigma * sigma * Eigen::Matrix2d::Identity() + turn * found.slack * turn.transpose();
  return motion;
}

double evidence_of_motion(const MotionToNext& motion) {
  return motion.step_m.dot(motion.step_covariance.inverse() * motion.step_m);
}

MotionPrior expect_on_the_way(const MotionToNext& motion, double dt,
                              const MotionPriorOptions& options) {
  const double share = std::clamp(dt / motion.dt, 0., 1.);
  const double both_ways = share * (1 - share) * motion.dt * motion.dt;  // s^2
  MotionPrior prior = expect_motion(KnownMotion{}, {}, Eigen::Matrix3d::Identity(),
                                    Eigen::Vector3d::Zero(), dt, options);
  prior.T_mov = exp_se3(Twist(log_se3(motion.T_mov) * share));
  prior.position_covariance =
      share * share * motion.step_covariance +
      std::pow(0.5 * options.acceleration_sigma * both_ways, 2) * Eigen::Matrix2d::Identity() +
      0.005 * 0.005 * Eigen::Matrix2d::Identity();
  return prior;
}

}  // namespace lidar_upsampling
