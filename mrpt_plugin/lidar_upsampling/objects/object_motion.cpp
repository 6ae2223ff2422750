// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_motion.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/vision/pose_likelihood.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

using Correspondences = std::vector<Correspondence>;

// Root mean squared distance on the picture between two hypotheses.
double distance_px(const Correspondences& correspondences, const CameraModel& camera, const Pose& a,
                   const Pose& b) {
  Correspondences seen_from_a;
  for (const Correspondence& pair : correspondences)
    if (const auto pixel = project(camera, a * pair.point_in_source, -1e4))
      seen_from_a.push_back({pair.point_in_source, *pixel});
  double sum = 0;
  for (const double error : reprojection_errors(seen_from_a, camera, b)) sum += error * error;
  return std::sqrt(sum / std::max<double>(1., static_cast<double>(seen_from_a.size())));
}

// How much likelier the moving hypothesis is than the parked one, as a likelihood ratio statistic.
double evidence_of_motion(const Correspondences& correspondences, const MotionQuery& query,
                          const AbsolutePose& moving, const Pose& T_parked,
                          const ObjectMotionOptions& options) {
  const double before = options.prior.any() ? query.known_evidence : 0;
  const double distance =
      distance_px(correspondences, query.camera, T_parked, moving.T_camera_source);
  // What ego-motion and calibration are wrong by moves all points alike: it is no evidence, near
  // the tolerance as little as below it.
  const double beyond = 1 - std::pow(options.static_tolerance_px / distance, 2);
  if (!(beyond > 0)) return before;
  const double share = query.next_tells ? 1 : beyond;
  const double sigma = std::max(0.5 * options.pose.sigma_px, moving.rmse_px);
  return before + share *
                      (picture_cost(correspondences, query.camera, T_parked, sigma) -
                       picture_cost(correspondences, query.camera, moving.T_camera_source, sigma)) /
                      options.pose.points_per_observation;
}

// Of the centroid, in the axes of the lidar frame at the image. What all tracks of an object share
// (its points' depths, the anchor's errors) does not show in their scatter: as much again, as
// rawlog-evaluate's table of uncertainties tells on simulated logs.
Eigen::Matrix3d position_covariance(const AbsolutePose& pose, const MotionQuery& query) {
  constexpr double kShared = 2;
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -skew(pose.T_camera_source * query.centroid_lidar_k), Eigen::Matrix3d::Identity();
  jacobian = query.T_camera_lidar.linear().transpose() * jacobian;
  return kShared * jacobian * pose.covariance * jacobian.transpose();
}

Eigen::Matrix3d position_covariance(const MotionPrior& prior, const MotionQuery& query) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() = prior.position_covariance;
  covariance(2, 2) = prior.height_sigma_m * prior.height_sigma_m;
  const Eigen::Matrix3d R = query.T_lidar_t_lidar_k.linear();
  return R * covariance * R.transpose();
}

// Without the picture: on by the motion measured before, if it is one, else parked.
void fall_back(ObjectMotion& motion, const MotionQuery& query, MotionStatus status,
               const ObjectMotionOptions& options) {
  motion.status = status;
  const bool is_known = query.known_moving || query.known_evidence >= options.static_significance;
  if (!options.prior.any() || !is_known) return;
  set_motion(motion, query.T_lidar_t_lidar_k * query.prior.T_mov, query);
  motion.position_covariance = position_covariance(query.prior, query);
  motion.status = MotionStatus::predicted;
}

std::optional<AbsolutePose> solve_pose(const Correspondences& correspondences,
                                       const MotionQuery& query,
                                       const std::optional<PosePrior>& prior,
                                       const ObjectMotionOptions& options) {
  const Pose T_expected = query.T_camera_lidar * query.T_lidar_t_lidar_k * query.prior.T_mov;
  auto pose = estimate_absolute_pose(correspondences, query.camera, options.pose, T_expected);
  if (!pose || !prior) return pose;
  auto likeliest = refine_likeliest_pose(correspondences, query.camera,
                                         {pose->T_camera_source, T_expected}, options.pose, *prior);
  return likeliest ? likeliest : pose;
}

}  // namespace

void set_motion(ObjectMotion& motion, const Pose& T_lidar_t_lidar_k, const MotionQuery& query) {
  motion.T_lidar_t_lidar_k = T_lidar_t_lidar_k;
  motion.T_mov = query.T_lidar_t_lidar_k.inverse() * T_lidar_t_lidar_k;
  if (query.dt <= 0) return;
  motion.velocity_lidar_k =
      (motion.T_mov * motion.centroid_lidar_k - motion.centroid_lidar_k) / query.dt;
  motion.yaw_rate = std::atan2(motion.T_mov.linear()(1, 0), motion.T_mov.linear()(0, 0)) / query.dt;
}

ObjectMotion estimate_object_motion(const Correspondences& correspondences,
                                    const MotionQuery& query, const ObjectMotionOptions& options) {
  ObjectMotion motion;
  motion.num_tracked = static_cast<int>(correspondences.size());
  motion.centroid_lidar_k = query.centroid_lidar_k;
  set_motion(motion, query.T_lidar_t_lidar_k, query);
  if (motion.num_tracked < options.min_points) {
    fall_back(motion, query, MotionStatus::too_few_points, options);
    return motion;
  }

  const Pose T_parked = query.T_camera_lidar * query.T_lidar_t_lidar_k;
  std::optional<PosePrior> prior;
  if (options.prior.any()) prior = pose_prior(query.prior, T_parked, query.centroid_lidar_k);
  const auto pose = solve_pose(correspondences, query, prior, options);
  ObjectMotion moved = motion;
  if (pose) set_motion(moved, query.T_camera_lidar.inverse() * pose->T_camera_source, query);
  if (!pose || moved.velocity_lidar_k.norm() > options.max_speed) {
    fall_back(motion, query, MotionStatus::no_consensus, options);
    return motion;
  }

  ObjectMotion& result = moved;
  result.status = MotionStatus::moving;
  if (options.static_test && evidence_of_motion(correspondences, query, *pose, T_parked, options) <
                                 options.static_significance) {
    const Eigen::Vector3d where_moved = moved.T_lidar_t_lidar_k * query.centroid_lidar_k;
    result = motion;
    result.status = MotionStatus::stationary;
    result.unproven_step = where_moved - motion.T_lidar_t_lidar_k * query.centroid_lidar_k;
  }
  result.num_inliers = pose->num_inliers;
  result.rmse_px = pose->rmse_px;
  result.position_covariance = position_covariance(*pose, query);
  return result;
}

}  // namespace lidar_upsampling
