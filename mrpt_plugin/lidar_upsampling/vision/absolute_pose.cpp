// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/absolute_pose.h"

#include <array>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "lidar_upsampling/checks.h"
#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/robust/ransac.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/units.h"
#include "lidar_upsampling/vision/distortion.h"
#include "lidar_upsampling/vision/observation.h"
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
        max_sq_error_(std::pow(options.max_inlier_sigmas * options.sigma_px, 2)) {}

  [[nodiscard]] int num_data() const { return static_cast<int>(observations_.size()); }

  /// Points on a line have no finite pose, which cannot win.
  void generate_models(const std::array<int, sample_size>& sample,
                       std::vector<Pose>* models) const {
    std::array<cv::Point3d, sample_size> points;
    std::array<cv::Point2d, sample_size> pixels;
    for (std::size_t i = 0; i < sample_size; ++i) {
      const Observation& drawn = observations_[static_cast<std::size_t>(sample[i])];
      const Eigen::Vector3d& point = drawn.point_in_source;
      points[i] = {point.x(), point.y(), point.z()};
      pixels[i] = {drawn.normalised.x(), drawn.normalised.y()};
    }
    std::vector<cv::Vec3d> turns, translations;
    cv::solveP3P(points, pixels, cv::Matx33d::eye(), cv::noArray(), turns, translations,
                 cv::SOLVEPNP_AP3P);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      Pose pose = Pose::Identity();
      pose.linear() = rotation_exp(Eigen::Vector3d(turns[i].val));
      pose.translation() = Eigen::Vector3d(translations[i].val);
      models->push_back(pose);
    }
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
      const Twist increment = solved<6, 1>(normal, right);
      if (!increment.allFinite()) return;
      T_camera_source = incremented(increment, T_camera_source);
    }
  }

 private:
  const std::vector<Observation>& observations_;
  double sigma_px_;
  double outlier_density_;
  double max_sq_error_;
  double lowest_cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void check(const AbsolutePoseOptions& options) {
  const auto& o = options;
  require(o.sigma_px > 0, "absolute pose: sigma_px must be positive", o.sigma_px);
  require(o.outlier_range_px > 0, "absolute pose: outlier_range_px must be positive",
          o.outlier_range_px);
  require(o.max_inlier_sigmas > 0, "absolute pose: max_inlier_sigmas must be positive",
          o.max_inlier_sigmas);
  require(o.loss_scale_px > 0, "absolute pose: loss_scale_px must be positive", o.loss_scale_px);
  require(o.min_inliers >= 4, "absolute pose: min_inliers must be at least 4", o.min_inliers);
  require(o.min_inlier_ratio >= 0 && o.min_inlier_ratio <= 1,
          "absolute pose: min_inlier_ratio must be within [0, 1]", o.min_inlier_ratio);
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
  return refine_absolute_pose(correspondences, model, *found.model, refine_options);
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
    const Eigen::Vector2d pixel = focal.cwiseProduct(distort(model, normalised).point) + centre;
    errors[i] = (pixel - correspondences[i].pixel).norm();
  }
  return errors;
}

}  // namespace lidar_upsampling
