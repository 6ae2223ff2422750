// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/pose_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lidar_upsampling {

double picture_cost(const std::vector<Correspondence>& correspondences, const CameraModel& camera,
                    const Pose& T_camera_source, double sigma_px) {
  constexpr double kFarOff = 1e6;
  double sum = 0;
  for (const double error : reprojection_errors(correspondences, camera, T_camera_source))
    sum += 2 * std::log1p(std::min(error * error / (sigma_px * sigma_px), kFarOff));
  return sum;
}

double prior_cost(const PosePrior& prior, const Pose& T_camera_source) {
  const Pose step = T_camera_source * prior.T_mean.inverse();
  const Eigen::AngleAxisd turn(step.linear());
  Eigen::Matrix<double, 6, 1> increment;
  increment << turn.angle() * turn.axis(), step.translation();
  return (prior.sqrt_information * increment).squaredNorm();
}

std::optional<AbsolutePose> refine_likeliest_pose(
    const std::vector<Correspondence>& correspondences, const CameraModel& camera,
    const std::vector<Pose>& starts, const AbsolutePoseOptions& options, const PosePrior& prior,
    double points_per_observation) {
  std::optional<AbsolutePose> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Pose& start : starts) {
    auto pose = refine_absolute_pose(correspondences, camera, start, options, prior);
    if (!pose) continue;
    const double cost =
        picture_cost(correspondences, camera, pose->T_camera_source, options.sigma_px) /
            points_per_observation +
        prior_cost(prior, pose->T_camera_source);
    if (cost >= least) continue;
    least = cost;
    best = std::move(pose);
  }
  return best;
}

}  // namespace lidar_upsampling
