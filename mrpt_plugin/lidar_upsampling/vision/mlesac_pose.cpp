// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/mlesac_pose.h"

#include <Eigen/Cholesky>

#include "lidar_upsampling/vision/distortion.h"
#include "lidar_upsampling/vision/p3p.h"
#include "lidar_upsampling/vision/pose_increment.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kEmIterations = 5;
constexpr int kRefineSteps = 2;

}  // namespace

std::vector<Observation> observe(const std::vector<Correspondence>& correspondences,
                                 const CameraModel& model) {
  check(model);
  const double max_radius = valid_radius(model);
  const Eigen::Vector2d focal(model.fx, model.fy);
  std::vector<Observation> observations;
  observations.reserve(correspondences.size());
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const auto& [point, pixel] = correspondences[i];
    if (!point.allFinite() || !pixel.allFinite()) {
      throw std::invalid_argument("absolute pose: correspondence " + std::to_string(i) +
                                  " has a coordinate that is not a finite number");
    }
    const Eigen::Vector2d distorted =
        (pixel - Eigen::Vector2d(model.cx, model.cy)).cwiseQuotient(focal);
    const auto normalised = undistort_normalised(model, distorted, max_radius);
    if (!normalised) continue;
    observations.push_back({point, *normalised,
                            focal.asDiagonal() * distort_with_jacobian(model, *normalised).jacobian,
                            static_cast<int>(i)});
  }
  return observations;
}

double sq_reprojection_error(const Observation& observation, const Pose& T_camera_source) {
  const Eigen::Vector3d point = T_camera_source * observation.point_in_source;
  if (!(point.z() > kNearestDepth)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d difference = point.head<2>() / point.z() - observation.normalised;
  return (observation.pixel_by_normalised * difference).squaredNorm();
}

MlesacPose::MlesacPose(const std::vector<Observation>& observations,
                       const AbsolutePoseOptions& options)
    : observations_(observations),
      sigma_px_(options.sigma_px),
      outlier_density_(1 / (options.outlier_range_px * options.outlier_range_px)),
      max_sq_error_(std::pow(options.max_inlier_sigmas * options.sigma_px, 2)) {
  bearings_.reserve(observations.size());
  for (const auto& observation : observations) {
    bearings_.push_back(observation.normalised.homogeneous().normalized());
  }
}

void MlesacPose::generate_models(const std::array<int, sample_size>& sample,
                                 std::vector<Pose>* models) const {
  std::array<Eigen::Vector3d, 3> bearings;
  std::array<Eigen::Vector3d, 3> points;
  for (std::size_t i = 0; i < sample_size; ++i) {
    const auto drawn = static_cast<std::size_t>(sample[i]);
    bearings[i] = bearings_[drawn];
    points[i] = observations_[drawn].point_in_source;
  }
  solve_p3p(bearings, points, models);
}

ModelScore MlesacPose::score_model(const Pose& T_camera_source) const {
  Eigen::ArrayXd sq_errors(observations_.size());
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    sq_errors[static_cast<Eigen::Index>(i)] =
        sq_reprojection_error(observations_[i], T_camera_source);
  }
  const double sq_sigma = sigma_px_ * sigma_px_;
  const Eigen::ArrayXd density = (sq_errors * (-0.5 / sq_sigma)).exp() / (2 * kPi * sq_sigma);
  double mixing = 0.5;
  for (int i = 0; i < kEmIterations; ++i) {
    mixing = (mixing * density / (mixing * density + (1 - mixing) * outlier_density_)).mean();
  }
  const double log_likelihood = (mixing * density + (1 - mixing) * outlier_density_).log().sum();
  return {-log_likelihood, static_cast<int>((sq_errors < max_sq_error_).count())};
}

void MlesacPose::refine_model(Pose& T_camera_source) const {
  for (int step = 0; step < kRefineSteps; ++step) {
    Matrix6d normal = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    int count = 0;
    for (const auto& observation : observations_) {
      const auto at = reprojection(observation, T_camera_source);
      if (!at || at->residual.squaredNorm() > max_sq_error_) continue;
      normal.noalias() += at->jacobian.transpose() * at->jacobian;
      right.noalias() -= at->jacobian.transpose() * at->residual;
      ++count;
    }
    if (count < 4) return;
    const Vector6d increment = normal.ldlt().solve(right);
    if (!increment.allFinite()) return;
    T_camera_source = incremented(increment, T_camera_source);
  }
}

}  // namespace lidar_upsampling
