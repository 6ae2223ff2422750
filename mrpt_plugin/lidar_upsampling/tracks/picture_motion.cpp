// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/picture_motion.h"

#include <Eigen/Geometry>

namespace lidar_upsampling {

std::optional<MotionFit> picture_motion(const std::vector<Correspondence>& correspondences,
                                        const CameraModel& camera, const Pose& T_camera_lidar_k,
                                        const Eigen::Vector3d& centroid,
                                        const PictureMotionOptions& options) {
  if (static_cast<int>(correspondences.size()) < options.min_points) return {};
  const auto pose = estimate_absolute_pose(correspondences, camera, options.pose, T_camera_lidar_k);
  if (!pose) return {};
  const Pose T_mov = T_camera_lidar_k.inverse() * pose->T_camera_source;
  const Eigen::AngleAxisd turn(T_mov.linear());
  MotionFit fit;
  fit.mean << turn.angle() * turn.axis(), T_mov * centroid - centroid;
  // From an increment of the camera frame to a turn and a step in the lidar's axes.
  const Matrix6d by_increment =
      increment_at(pose->T_camera_source * centroid, T_camera_lidar_k.linear().transpose());
  fit.covariance = by_increment * pose->covariance * by_increment.transpose();
  fit.num_inliers = pose->num_inliers;
  fit.rmse_px = pose->rmse_px;
  return fit;
}

MotionAnswer answer_of_picture(const ObjectTrack& track, const std::optional<MotionFit>& fit,
                               const MotionQuestion& question,
                               const PictureMotionOptions& options) {
  MotionAnswer answer;
  answer.state = track.latest;
  const double dt = seconds_between(track.stamp, question.instant);
  if (!fit || fit->mean.tail<3>().norm() > options.max_speed * dt) return answer;
  answer.is_seen = answer.moves = true;
  answer.log_ratio = -track.log_odds;  // where it goes next is anybody's guess
  answer.moving = *fit;
  // Where to look for it on the next picture.
  answer.state.stamp = question.instant;
  answer.state.mean.setZero();
  answer.state.mean.head<3>() << level_axes(question.R_rest_lidar_k) * fit->mean.segment<2>(3),
      fit->mean[2];
  answer.state.mean.segment<3>(3) = answer.state.mean.head<3>() / dt;
  return answer;
}

}  // namespace lidar_upsampling
