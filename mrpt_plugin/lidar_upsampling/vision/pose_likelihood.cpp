// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/pose_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lidar_upsampling {
namespace {

// The noise of the inliers, per axis, with the expected one as a few more of them; who counts as an
// inlier stays.
AbsolutePoseOptions with_noise(AbsolutePoseOptions options, const AbsolutePose& pose) {
  constexpr double kExpectedCounts = 4;
  constexpr double kFinest_px = 0.05;
  const double gate_px = options.max_inlier_sigmas * options.sigma_px;
  const double sq_sigma = (kExpectedCounts * options.sigma_px * options.sigma_px +
                           0.5 * pose.num_inliers * pose.rmse_px * pose.rmse_px) /
                          (kExpectedCounts + pose.num_inliers);
  options.sigma_px = std::max(kFinest_px, std::sqrt(sq_sigma));
  options.max_inlier_sigmas = gate_px / options.sigma_px;
  return options;
}

}  // namespace

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
    const std::vector<Pose>& starts, const AbsolutePoseOptions& options, const PosePrior& prior) {
  std::optional<AbsolutePose> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Pose& start : starts) {
    auto pose = refine_absolute_pose(correspondences, camera, start, options, prior);
    if (!pose) continue;
    const double cost =
        picture_cost(correspondences, camera, pose->T_camera_source, options.sigma_px) /
            options.points_per_observation +
        prior_cost(prior, pose->T_camera_source);
    if (cost >= least) continue;
    least = cost;
    best = std::move(pose);
  }
  if (!best) return best;
  auto weighed = refine_absolute_pose(correspondences, camera, best->T_camera_source,
                                      with_noise(options, *best), prior);
  return weighed ? weighed : best;
}

}  // namespace lidar_upsampling
