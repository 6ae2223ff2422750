// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_motion.h"

#include <cmath>

namespace lidar_upsampling {
namespace {

Eigen::Vector3d centroid_of(const std::vector<Correspondence>& correspondences) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Correspondence& pair : correspondences) sum += pair.point_in_source;
  return sum / std::max<double>(1., static_cast<double>(correspondences.size()));
}

// Robust reprojection cost in units of the noise: what a Cauchy error of sigma_px makes of it.
double cost(const std::vector<Correspondence>& correspondences, const CameraModel& camera,
            const Pose& T_camera_source, double sigma_px) {
  double sum = 0;
  for (const double error : reprojection_errors(correspondences, camera, T_camera_source))
    sum += std::log1p(error * error / (sigma_px * sigma_px));
  return sum;
}

// Twice the log-likelihood ratio of the free motion over none, against the chi-square that six more
// parameters reach by chance.
bool is_stationary(const std::vector<Correspondence>& correspondences, const MotionQuery& query,
                   const AbsolutePose& free, const Pose& T_camera_lidar_ego,
                   const ObjectMotionOptions& options) {
  const double sigma = std::max(options.pose.sigma_px, free.rmse_px);
  const double gain = cost(correspondences, query.camera, T_camera_lidar_ego, sigma) -
                      cost(correspondences, query.camera, free.T_camera_source, sigma);
  return gain / options.points_per_observation < options.static_significance;
}

}  // namespace

void set_motion(ObjectMotion& motion, const Pose& T_lidar_t_lidar_k, const MotionQuery& query) {
  motion.T_lidar_t_lidar_k = T_lidar_t_lidar_k;
  motion.T_mov = query.T_lidar_t_lidar_k.inverse() * T_lidar_t_lidar_k;
  if (query.dt <= 0) return;
  motion.velocity_lidar_k =
      (motion.T_mov * motion.centroid_lidar_k - motion.centroid_lidar_k) / query.dt;
  motion.yaw_rate =
      std::atan2(motion.T_mov.linear()(1, 0), motion.T_mov.linear()(0, 0)) / query.dt;
}

ObjectMotion estimate_object_motion(const std::vector<Correspondence>& correspondences,
                                    const MotionQuery& query, const ObjectMotionOptions& options) {
  ObjectMotion motion;
  motion.num_tracked = static_cast<int>(correspondences.size());
  motion.centroid_lidar_k = centroid_of(correspondences);
  set_motion(motion, query.T_lidar_t_lidar_k, query);
  if (motion.num_tracked < options.min_points) {
    motion.status = MotionStatus::too_few_points;
    return motion;
  }

  const Pose T_camera_t_lidar_k_ego = query.T_camera_lidar * query.T_lidar_t_lidar_k;
  const Pose T_predicted = T_camera_t_lidar_k_ego * query.T_mov_predicted;
  const auto pose =
      estimate_absolute_pose(correspondences, query.camera, options.pose, T_predicted);
  motion.status = MotionStatus::no_consensus;
  if (!pose) return motion;
  motion.num_inliers = pose->num_inliers;
  motion.rmse_px = pose->rmse_px;

  if (options.static_test &&
      is_stationary(correspondences, query, *pose, T_camera_t_lidar_k_ego, options)) {
    motion.status = MotionStatus::stationary;
    return motion;
  }
  ObjectMotion moved = motion;
  set_motion(moved, query.T_camera_lidar.inverse() * pose->T_camera_source, query);
  if (moved.velocity_lidar_k.norm() > options.max_speed) return motion;
  moved.status = MotionStatus::moving;
  return moved;
}

}  // namespace lidar_upsampling
