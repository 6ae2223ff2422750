// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/mlesac_pose.h"

#include <Eigen/Cholesky>

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/units.h"
#include "lidar_upsampling/vision/p3p.h"

namespace lidar_upsampling {
namespace {

constexpr int kEmIterations = 5;
constexpr int kRefineSteps = 2;

}  // namespace

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

ModelScore MlesacPose::score_model(const Pose& T_camera_source) {
  Eigen::ArrayXd sq_errors(observations_.size());
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    sq_errors[static_cast<Eigen::Index>(i)] =
        sq_reprojection_error(observations_[i], T_camera_source);
  }
  const double sq_sigma = sigma_px_ * sigma_px_;
  const double log_inlier = -std::log(2 * kPi * sq_sigma);
  const double log_outlier = std::log(outlier_density_);
  const Eigen::ArrayXd log_density = log_inlier - sq_errors * (0.5 / sq_sigma);
  // No mixture exceeds the greater of its parts: most hypotheses are out before EM.
  if (-log_density.max(log_outlier).sum() >= lowest_cost_) return {};

  const Eigen::ArrayXd density = log_density.exp();
  double mixing = 0.5;
  for (int i = 0; i < kEmIterations; ++i) {
    mixing = (mixing * density / (mixing * density + (1 - mixing) * outlier_density_)).mean();
  }
  const double log_likelihood = (mixing * density + (1 - mixing) * outlier_density_).log().sum();
  lowest_cost_ = std::min(lowest_cost_, -log_likelihood);
  return {-log_likelihood, static_cast<int>((sq_errors < max_sq_error_).count())};
}

void MlesacPose::refine_model(Pose& T_camera_source) const {
  for (int step = 0; step < kRefineSteps; ++step) {
    Matrix6d normal = Matrix6d::Zero();
    Twist right = Twist::Zero();
    int count = 0;
    for (const auto& observation : observations_) {
      const auto at = reprojection(observation, T_camera_source);
      if (!at || at->residual.squaredNorm() > max_sq_error_) continue;
      normal.noalias() += at->jacobian.transpose() * at->jacobian;
      right.noalias() -= at->jacobian.transpose() * at->residual;
      ++count;
    }
    if (count < 4) return;
    const Twist increment = normal.ldlt().solve(right);
    if (!increment.allFinite()) return;
    T_camera_source = incremented(increment, T_camera_source);
  }
}

}  // namespace lidar_upsampling
