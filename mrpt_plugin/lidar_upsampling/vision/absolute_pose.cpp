// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/absolute_pose.h"

#include <Eigen/Cholesky>
#include <array>
#include <limits>
#include <vector>

#include "lidar_upsampling/robust/ransac.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/units.h"
#include "lidar_upsampling/vision/distortion.h"
#include "lidar_upsampling/vision/observation.h"
#include "lidar_upsampling/vision/p3p.h"
#include "lidar_upsampling/vision/projection.h"
#include "lidar_upsampling/vision/refine_pose.h"

namespace lidar_upsampling {
namespace {

constexpr int kEmIterations = 5;
constexpr int kRefineSteps = 2;

/// P3P hypotheses scored by the negative log likelihood of a mixture of Gaussian inliers and
/// uniform outliers, its mixing parameter found by EM (Torr & Zisserman, CVIU 2000).
class MlesacPose {
 public:
  using Model = Pose;
  static constexpr std::size_t sample_size = 3;

  MlesacPose(const std::vector<Observation>& observations, const AbsolutePoseOptions& options)
      : observations_(observations),
        sigma_px_(options.sigma_px),
        outlier_density_(1 / (options.outlier_range_px * options.outlier_range_px)),
        max_sq_error_(std::pow(options.max_inlier_sigmas * options.sigma_px, 2)) {
    bearings_.reserve(observations.size());
    for (const auto& observation : observations) {
      bearings_.push_back(observation.normalised.homogeneous().normalized());
    }
  }

  [[nodiscard]] int num_data() const { return static_cast<int>(observations_.size()); }

  void generate_models(const std::array<int, sample_size>& sample,
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

  /// @return infinite cost for what cannot beat the best pose scored before.
  [[nodiscard]] ModelScore score_model(const Pose& T_camera_source) {
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

  /// Gauss-Newton steps on the inliers.
  void refine_model(Pose& T_camera_source) const {
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

 private:
  const std::vector<Observation>& observations_;
  std::vector<Eigen::Vector3d> bearings_;
  double sigma_px_;
  double outlier_density_;
  double max_sq_error_;
  double lowest_cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

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
  return refine_observed_pose({observations, num_total}, *found.model, refine_options);
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
