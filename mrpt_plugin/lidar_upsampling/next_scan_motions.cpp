// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/next_scan_motions.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/travel.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

constexpr double kGuessReach_m = 0.25;  // half a step of the search: so near, a guess leads there

double largest_sigma(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  return std::sqrt(std::max(0., solver.eigenvalues()[1]));
}

// The step until the next scan that a picture leads to, give or take what an acceleration can do.
LevelGaussian extrapolated(const ObjectMotion& motion, const MotionQuery& query, double dt_next,
                           const ObjectMotionOptions& options) {
  const double share = dt_next / query.dt;
  // One that is called parked may have moved by as much as the test lets pass.
  const double spread = motion.status == MotionStatus::stationary ? options.static_significance : 1;
  const Eigen::Matrix3d R = query.T_lidar_t_lidar_k.linear().transpose();
  const double bent = 0.5 * options.prior.acceleration_sigma * dt_next * (dt_next - query.dt);
  const Pose T_mov = exp_se3(Twist(log_se3(motion.T_mov) * share));
  LevelGaussian step;
  step.mean = (T_mov * query.centroid_lidar_k - query.centroid_lidar_k).head<2>();
  step.covariance = spread * share * share *
                        (R * motion.position_covariance * R.transpose()).topLeftCorner<2, 2>() +
                    bent * bent * Eigen::Matrix2d::Identity();
  return step;
}

// The candidate as it is to be found in the next scan.
SoughtObject sought(const Candidate& candidate, const Question& question, const Travel& travel,
                    const LidarScan& key_scan, double dt_next, const ObjectMotionOptions& options) {
  const bool picture_tells = question.motion.num_inliers > 0;
  SoughtObject object{points_at(key_scan, candidate.points),
                      shifted(key_scan.stamp, candidate.time_s),
                      {},
                      step_at(travel, dt_next)};
  object.is_whole = !is_proven(candidate);
  if (picture_tells)
    object.expected_step = extrapolated(question.motion, question.query, dt_next, options);
  object.search = !picture_tells || largest_sigma(object.expected_step.covariance) > kGuessReach_m;
  if (!candidate.rate.isZero())
    object.T_mov_guesses.push_back(exp_se3(Twist(candidate.rate * dt_next)));
  if (question.motion.status == MotionStatus::moving)
    object.T_mov_guesses.push_back(
        exp_se3(Twist(log_se3(question.motion.T_mov) * (dt_next / question.query.dt))));
  return object;
}

// What is known of the candidate at the next scan.
KnownMotion known_at(Stamp next, const Travel& travel, const Twist& rate,
                     const Candidate& candidate, const Eigen::Matrix3d& R_rest_lidar_k) {
  KnownMotion known;
  known.found_moving = candidate.known && candidate.known->found_moving;
  known.stamp = next;
  known.from_scans = true;
  known.travel = turned(travel, R_rest_lidar_k);
  known.velocity_at_rest.head<2>() = known.travel->mean.head<2>();
  known.velocity_covariance = known.travel->covariance.topLeftCorner<2, 2>();
  known.yaw_rate = rate.z();
  return known;
}

// A patch on a depth edge shows what is before or behind its point, too, and may stay there: it
// tells the place to its own half width only.
bool is_surer_than_edges(const Travel& travel, const Candidate& candidate, const MotionQuery& query,
                         double dt_next) {
  constexpr double kHalfPatch_px = 7.5;
  const double range = (query.T_camera_lidar * candidate.centroid).norm();
  const double half_patch_m = kHalfPatch_px / query.camera.fx * range;
  return largest_sigma(step_at(travel, dt_next).covariance) < half_patch_m;
}

// Whether patches seem to stay, or nearly, that may as well be stuck on an edge.
bool is_held_back(const Question& question, const Travel& travel, const Candidate& candidate,
                  double dt_next) {
  constexpr double kHalf = 0.5;
  const MotionQuery& query = question.query;
  if (!candidate.on_edges || question.motion.num_inliers == 0 ||
      !is_surer_than_edges(travel, candidate, query, dt_next))
    return false;
  const Eigen::Vector3d step =
      question.motion.T_mov * query.centroid_lidar_k - query.centroid_lidar_k;
  return question.motion.status == MotionStatus::stationary ||
         step.head<2>().norm() < kHalf * step_at(travel, query.dt).mean.norm();
}

}  // namespace

void use_next_scan(Candidate& candidate, Question& question, const CameraView& view,
                   const LidarScan& key_scan, const NextScan& next,
                   const ObjectMotionOptions& options) {
  const MotionQuery& query = question.query;
  const Stamp stamp_k = shifted(key_scan.stamp, candidate.time_s);
  const double dt_next = seconds_between(stamp_k, next.stamp);
  const Travel before =
      expect_travel(candidate.known, stamp_k, view.R_rest_lidar_k.transpose(), options.prior);
  if (candidate.foreseen && is_held_back(question, before, candidate, dt_next)) {
    question.pairs.clear();
    question.motion = estimate_object_motion({}, query, options);
  }
  const bool seen_moving = question.motion.status == MotionStatus::moving;
  if (!candidate.to_next || (seen_moving && !candidate.to_next_is_guided)) {
    candidate.to_next =
        measure_to_next(sought(candidate, question, before, key_scan, dt_next, options), next);
    candidate.to_next_is_guided = seen_moving;
  }
  if (!candidate.to_next) return;
  const Travel travel = having_seen(before, candidate.to_next->step, dt_next);
  candidate.at_next =
      known_at(next.stamp, later(travel, dt_next, options.prior),
               log_se3(candidate.to_next->T_mov) / dt_next, candidate, view.R_rest_lidar_k);
  if (is_held_back(question, travel, candidate, dt_next)) {
    question.pairs.clear();
    question.motion.num_inliers = 0;
  }
  MotionQuery on_the_way = query;
  on_the_way.next_tells = false;
  const bool alone = static_cast<int>(question.pairs.size()) < options.min_points;
  on_the_way.known_evidence = evidence_of_motion(travel, dt_next, alone);
  on_the_way.known_moving = candidate.known && candidate.known->found_moving;
  on_the_way.prior = expect_on_the_way(*candidate.to_next, travel, query.dt, options.prior);
  ObjectMotion known = estimate_object_motion(question.pairs, on_the_way, options);
  constexpr double kContradicted = 0.5;
  if (known.num_inliers < kContradicted * question.motion.num_inliers) return;
  question.motion = std::move(known);
  question.query = on_the_way;
}

void learn_from_picture(Candidate& candidate, const ObjectMotion& motion, const MotionQuery& query,
                        const CameraView& view, const MotionPriorOptions& options) {
  const Stamp next = candidate.at_next->stamp;
  const double dt_next = candidate.to_next->dt;
  const Eigen::Matrix3d R = query.T_lidar_t_lidar_k.linear().transpose();
  const LevelGaussian step{
      (motion.T_mov * motion.centroid_lidar_k - motion.centroid_lidar_k).head<2>(),
      (R * motion.position_covariance * R.transpose()).topLeftCorner<2, 2>()};
  const Travel before = expect_travel(candidate.known, shifted(next, -dt_next),
                                      view.R_rest_lidar_k.transpose(), options);
  const Travel travel = having_seen(before, step, query.dt);
  const KnownMotion seen =
      known_at(next, later(travel, dt_next, options), log_se3(motion.T_mov) / query.dt, candidate,
               view.R_rest_lidar_k);
  if (seen.velocity_covariance.trace() < candidate.at_next->velocity_covariance.trace())
    candidate.at_next = seen;
}

}  // namespace lidar_upsampling
