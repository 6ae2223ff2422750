// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/motion_to_next.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/registration/object_registration.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr double kRegistrationSigma_m = 0.02;
constexpr double kSearch_m = 2;            // around rest, for objects of which nothing is known
constexpr double kImprobable = 16;         // chi-square of two degrees of freedom
constexpr double kWorstResidual_m = 0.15;  // of what may be the same surface
constexpr double kMostRise_m = 0.1;        // what a road user may rise or sink
constexpr double kUnevenness_m = 0.04;     // of the ground, and twice what is told of heights
constexpr double kSlope = 0.1;             // of what rings pass over, per height: a place ahead
constexpr double kUnexplained_m = 0.05;    // by which an expectation may be off anyway

/// The step over ground as a place in the next scan.
ExpectedPlace place_of(const LevelGaussian& step, const Eigen::Vector3d& centroid,
                       const Pose& T_next_k) {
  Eigen::Vector3d at = centroid;
  at.head<2>() += step.mean;
  const Eigen::Matrix2d turn = T_next_k.linear().topLeftCorner<2, 2>();
  return {(T_next_k * at).head<2>(), turn * step.covariance * turn.transpose()};
}

/// Where something stood before, while the object seems to be where it was.
bool is_lookalike(const SoughtObject& object, const ObjectRegistration& found,
                  const Eigen::Vector2d& step, const NextScan& next) {
  const Pose& T_next_k = next.T_lidar_next_lidar_k;
  if (next.seen_k == nullptr ||
      !was_there_then({object.points, *next.seen_k, object.is_whole}, -step, T_next_k, next.seen))
    return false;
  std::vector<Eigen::Vector3f> there;
  for (const Eigen::Vector3f& point : object.points)
    there.emplace_back(found.T_target_object.cast<float>() * point);
  const Eigen::Matrix2d turn = T_next_k.linear().topLeftCorner<2, 2>();
  return was_there_then({there, next.seen, object.is_whole}, turn * step, T_next_k.inverse(),
                        *next.seen_k);
}

}  // namespace

std::optional<MotionToNext> measure_to_next(const SoughtObject& object, const NextScan& next) {
  const Pose& T_next_k = next.T_lidar_next_lidar_k;
  std::vector<Pose> guesses{T_next_k};
  for (const Pose& T_mov : object.T_mov_guesses) guesses.push_back(T_next_k * T_mov);
  MotionToNext motion;
  motion.dt = seconds_between(object.stamp, next.stamp);
  motion.centroid_k = mean_of(object.points);
  LevelGaussian expected = object.expected_step;
  expected.covariance += kUnexplained_m * kUnexplained_m * Eigen::Matrix2d::Identity();
  const ExpectedPlace place = place_of(expected, motion.centroid_k, T_next_k);
  const ObjectRegistrationOptions options =
      options_between_scans(200, 20, object.search ? kSearch_m : 0);
  const ObjectRegistration found = register_object(object.points, next.surface, guesses, options,
                                                   {&place, &next.seen, next.seen_k});

  motion.T_mov = T_next_k.inverse() * found.T_target_object;
  motion.step.mean = (motion.T_mov * motion.centroid_k - motion.centroid_k).head<2>();
  const double rise = std::abs((motion.T_mov * motion.centroid_k - motion.centroid_k).z());
  // Neighbouring points err alike: ten count as one. Both scans' rings cut a sloping surface at
  // other heights. What rises from the ground has slid up an inclined surface, or from ring to
  // ring.
  const double count =
      std::min<double>(static_cast<double>(object.points.size()), options.max_points) / 10;
  const double ring_gap_m = std::tan(next.vertical_step_deg * kDegree) * motion.centroid_k.norm();
  const double sigma = Eigen::Vector4d(kRegistrationSigma_m, found.residual_m / std::sqrt(count),
                                       kSlope * ring_gap_m, std::max(0., rise - kUnevenness_m))
                           .norm();
  const Eigen::Matrix2d turn = T_next_k.linear().transpose().topLeftCorner<2, 2>();
  motion.step.covariance =
      sigma * sigma * Eigen::Matrix2d::Identity() + turn * found.slack * turn.transpose();
  const bool is_seen =
      found.status == RegistrationStatus::reliable || found.status == RegistrationStatus::ambiguous;
  if (!is_seen || found.residual_m > kWorstResidual_m || rise > kMostRise_m ||
      disagreement(motion.step, expected) > kImprobable)
    return {};
  if (is_lookalike(object, found, motion.step.mean, next)) return {};
  return motion;
}

double evidence_of_motion(const Travel& travel, double dt, bool alone) {
  // Chi-squares of six and two degrees of freedom at one in a hundred, of two at one in twenty.
  constexpr double kOfSix = 16.81, kOfTwo = 9.21, kOfTwoAlone = 5.99;
  return kOfSix / (alone ? kOfTwoAlone : kOfTwo) * disagreement(step_at(travel, dt), {});
}

MotionPrior expect_on_the_way(const MotionToNext& motion, const Travel& travel, double dt,
                              const MotionPriorOptions& options) {
  const double share = std::clamp(dt / motion.dt, 0., 1.);
  const LevelGaussian step = step_at(travel, share * motion.dt);
  MotionPrior prior = expect_motion(KnownMotion{}, {}, Eigen::Matrix3d::Identity(),
                                    Eigen::Vector3d::Zero(), dt, options);
  prior.T_mov = exp_se3(Twist(log_se3(motion.T_mov) * share));
  const Eigen::Vector3d at = prior.T_mov * motion.centroid_k;
  prior.T_mov.translation().head<2>() += motion.centroid_k.head<2>() + step.mean - at.head<2>();
  prior.position_covariance = step.covariance + 0.005 * 0.005 * Eigen::Matrix2d::Identity();
  return prior;
}

}  // namespace lidar_upsampling
