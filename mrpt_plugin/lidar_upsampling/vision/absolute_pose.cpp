// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/absolute_pose.h"

#include <limits>

#include "lidar_upsampling/vision/distortion.h"
#include "lidar_upsampling/vision/mlesac_pose.h"
#include "lidar_upsampling/vision/projection.h"
#include "lidar_upsampling/vision/refine_pose.h"

namespace lidar_upsampling {

void check(const AbsolutePoseOptions& options) {
  const auto positive = [](const char* name, double value) {
    if (value > 0) return;
    throw std::invalid_argument(std::string("absolute pose: ") + name + " must be positive, not " +
                                std::to_string(value));
  };
  positive("sigma_px", options.sigma_px);
  positive("outlier_range_px", options.outlier_range_px);
  positive("max_inlier_sigmas", options.max_inlier_sigmas);
  positive("loss_scale_px", options.loss_scale_px);
  positive("first_gate_px", options.first_gate_px);
  positive("max_refine_iterations", options.max_refine_iterations);
  if (options.min_inliers < 4) {
    throw std::invalid_argument("absolute pose: min_inliers must be at least 4, not " +
                                std::to_string(options.min_inliers));
  }
  if (!(options.min_inlier_ratio >= 0 && options.min_inlier_ratio <= 1)) {
    throw std::invalid_argument("absolute pose: min_inlier_ratio must be within [0, 1], not " +
                                std::to_string(options.min_inlier_ratio));
  }
  check(options.ransac);
}

std::optional<AbsolutePose> estimate_absolute_pose(
    const std::vector<Correspondence>& correspondences, const CameraModel& model,
    const AbsolutePoseOptions& options, const std::optional<Pose>& initial) {
  check(options);
  const std::vector<Observation> observations = observe(correspondences, model);
  if (observations.size() < static_cast<std::size_t>(options.min_inliers)) return std::nullopt;
  MlesacPose estimator(observations, options);
  const auto found = ransac(estimator, options.ransac, initial);
  if (!found.model) return std::nullopt;
  AbsolutePoseOptions refine_options = options;
  refine_options.first_gate_px = 2 * options.max_inlier_sigmas * options.sigma_px;
  const int num_total = static_cast<int>(correspondences.size());
  auto pose = refine_observed_pose({observations, num_total}, *found.model, refine_options);
  if (pose) pose->ransac_iterations = found.stats.iterations;
  return pose;
}

std::vector<double> reprojection_errors(const std::vector<Correspondence>& correspondences,
                                        const CameraModel& model, const Pose& T_camera_source) {
  check(model);
  const double max_radius = valid_radius(model);
  const Eigen::Vector2d focal(model.fx, model.fy);
  const Eigen::Vector2d centre(model.cx, model.cy);
  std::vector<double> errors(correspondences.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const Eigen::Vector3d point = T_camera_source * correspondences[i].point_in_source;
    if (!(point.z() > kNearestDepth)) continue;
    const Eigen::Vector2d normalised = point.head<2>() / point.z();
    if (!(normalised.norm() < max_radius)) continue;
    const Eigen::Vector2d pixel = focal.cwiseProduct(distort(model, normalised)) + centre;
    errors[i] = (pixel - correspondences[i].pixel).norm();
  }
  return errors;
}

}  // namespace lidar_upsampling
