// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/refine_pose.h"

#include <ceres/loss_function.h>
#include <ceres/tiny_solver.h>

#include <Eigen/LU>
#include <cmath>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/vision/observation.h"

namespace lidar_upsampling {
namespace {

constexpr int kMaxRounds = 6;

/// How much the noise of few residuals counts against sigma_px: as so many of them.
constexpr double kSigmaWeight = 4;

/// Stands for a reprojection error behind the camera: no step that leads there is taken.
constexpr double kHugeResidual = 1e6;

/// The squared loss's root as a residual of its own: Ceres' tiny solver knows no losses, but half
/// the squared length of this residual is exactly Cauchy's loss of the original one.
struct RobustReprojection {
  Eigen::Vector2d residual;
  Eigen::Matrix2d by_residual;
};

RobustReprojection robustified(const ceres::LossFunction& loss, const Eigen::Vector2d& residual) {
  const double sq = residual.squaredNorm();
  double rho[3];
  loss.Evaluate(sq, rho);
  if (sq < 1e-12) return {residual, Eigen::Matrix2d::Identity()};
  const double factor = std::sqrt(rho[0] / sq);
  const double slope = (rho[1] - rho[0] / sq) / (2 * sq * factor);
  return {factor * residual,
          factor * Eigen::Matrix2d::Identity() + 2 * slope * residual * residual.transpose()};
}

/// [exp(w) | t] = pose * prior.T_mean^-1 as (w, t), and its derivative by a left increment of the
/// pose.
std::pair<Twist, Matrix6d> difference(const Pose& pose, const Pose& T_mean) {
  const Pose increment = pose * T_mean.inverse();
  Twist value;
  value << rotation_log(increment.linear()), increment.translation();
  Matrix6d jacobian = Matrix6d::Identity();
  jacobian.topLeftCorner<3, 3>() = left_jacobian(value.head<3>()).inverse();
  jacobian.bottomLeftCorner<3, 3>() = -skew(value.tail<3>());
  return {value, jacobian};
}

/// The residuals (in units of their standard deviation) by an increment of the initial pose, as
/// ceres::TinySolver wants them.
class ReprojectionCost {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 6 };

  ReprojectionCost(std::vector<const Observation*> observations, const Pose& T_initial,
                   const AbsolutePoseOptions& options, const std::optional<PosePrior>& prior)
      : observations_(std::move(observations)),
        T_initial_(T_initial),
        loss_(options.loss_scale_px),
        sigma_px_(options.sigma_px * std::sqrt(options.points_per_observation)),
        prior_(prior) {}

  [[nodiscard]] int NumResiduals() const {
    return 2 * static_cast<int>(observations_.size()) + (prior_ ? 6 : 0);
  }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const Twist> increment(parameters);
    const Pose pose = incremented(increment, T_initial_);
    Eigen::Map<Eigen::VectorXd> r(residuals, NumResiduals());
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6>> j(jacobian, jacobian ? NumResiduals() : 0,
                                                           6);
    const Matrix6d by_increment = left_increment_by(increment);
    Eigen::Index row = 0;
    for (const Observation* observation : observations_) {
      const auto at = reprojection(*observation, pose);
      if (!at) {
        r.segment<2>(row).setConstant(kHugeResidual);
        if (jacobian) j.middleRows<2>(row).setZero();
      } else {
        const RobustReprojection robust = robustified(loss_, at->residual);
        r.segment<2>(row) = robust.residual / sigma_px_;
        if (jacobian) {
          j.middleRows<2>(row) = robust.by_residual / sigma_px_ * at->jacobian * by_increment;
        }
      }
      row += 2;
    }
    if (prior_) {
      const auto [value, by_left_increment] = difference(pose, prior_->T_mean);
      r.tail<6>() = prior_->sqrt_information * value;
      if (jacobian) j.bottomRows<6>() = prior_->sqrt_information * by_left_increment * by_increment;
    }
    return true;
  }

 private:
  /// The derivative of the left increment of the resulting pose by the parameters.
  static Matrix6d left_increment_by(const Twist& increment) {
    const Eigen::Matrix3d jacobian = left_jacobian(increment.head<3>());
    Matrix6d result = Matrix6d::Identity();
    result.topLeftCorner<3, 3>() = jacobian;
    result.bottomLeftCorner<3, 3>() = skew(increment.tail<3>()) * jacobian;
    return result;
  }

  std::vector<const Observation*> observations_;
  Pose T_initial_;
  ceres::CauchyLoss loss_;
  double sigma_px_;
  std::optional<PosePrior> prior_;
};

std::vector<const Observation*> select(const std::vector<Observation>& observations,
                                       const Pose& pose, double gate_px) {
  std::vector<const Observation*> selected;
  selected.reserve(observations.size());
  for (const auto& observation : observations) {
    if (sq_reprojection_error(observation, pose) < gate_px * gate_px) {
      selected.push_back(&observation);
    }
  }
  return selected;
}

/// Covariance of an M-estimator (Huber, Robust Statistics, ch. 7): the noise is measured on the
/// inliers, with sigma_px as its prior; for Cauchy's loss the mean slope of the influence is that
/// of weight squared.
Matrix6d covariance(const std::vector<const Observation*>& inliers, const Pose& pose,
                    const AbsolutePoseOptions& options, const std::optional<PosePrior>& prior) {
  Matrix6d information = Matrix6d::Zero();
  double sum_sq_influence = 0;
  double sum_slope = 0;
  for (const Observation* observation : inliers) {
    const auto at = reprojection(*observation, pose);
    if (!at) continue;
    const double sq = at->residual.squaredNorm();
    const double weight = 1 / (1 + sq / (options.loss_scale_px * options.loss_scale_px));
    sum_sq_influence += weight * weight * sq;
    sum_slope += weight * weight;
    information.noalias() += at->jacobian.transpose() * at->jacobian;
  }
  const double count = static_cast<double>(inliers.size());
  const double mean_slope = inliers.empty() ? 1 : sum_slope / count;
  const double sq_sigma = (kSigmaWeight * options.sigma_px * options.sigma_px +
                           sum_sq_influence / (mean_slope * mean_slope)) /
                          (kSigmaWeight + std::max(0., 2 * count - 6));
  information /= sq_sigma * options.points_per_observation;
  if (prior) information += prior->sqrt_information.transpose() * prior->sqrt_information;
  // What nothing determines gets a huge variance, not an infinite or negative one.
  const SymmetricEigen<6> eigen = symmetric_eigen<6>(information);
  const Twist eigenvalues = eigen.values.cwiseMax(1e-12 * eigen.values[5]).cwiseMax(1e-12);
  return eigen.vectors * eigenvalues.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
}

/// Fits the pose to what lies near it, chosen anew until it no longer changes.
/// @return the inliers, fewer than four where there are not enough to go on.
std::vector<const Observation*> fit_to_inliers(const std::vector<Observation>& observations,
                                               const AbsolutePoseOptions& options,
                                               const std::optional<PosePrior>& prior,
                                               AbsolutePose& pose) {
  using Solver = ceres::TinySolver<ReprojectionCost>;
  const double inlier_gate = options.max_inlier_sigmas * options.sigma_px;
  auto selected = select(observations, pose.T_camera_source, options.first_gate_px);
  for (int round = 0; round < kMaxRounds && !pose.converged; ++round) {
    if (!prior && selected.size() < 4) break;
    Solver solver;
    solver.options.max_num_iterations = options.max_refine_iterations;
    solver.options.function_tolerance = 1e-12;
    solver.options.parameter_tolerance = 1e-10;
    Solver::Parameters increment = Solver::Parameters::Zero();
    const ReprojectionCost cost(selected, pose.T_camera_source, options, prior);
    solver.Solve(cost, &increment);
    pose.T_camera_source = incremented(increment, pose.T_camera_source);
    auto inliers = select(observations, pose.T_camera_source, inlier_gate);
    pose.converged = inliers == selected && solver.summary.status != Solver::HIT_MAX_ITERATIONS;
    selected = std::move(inliers);
  }
  return selected;
}

}  // namespace

std::optional<AbsolutePose> refine_absolute_pose(const std::vector<Correspondence>& correspondences,
                                                 const CameraModel& model, const Pose& T_initial,
                                                 const AbsolutePoseOptions& options,
                                                 const std::optional<PosePrior>& prior) {
  check(options);
  if (!T_initial.matrix().allFinite() ||
      (prior && !(prior->T_mean.matrix().allFinite() && prior->sqrt_information.allFinite()))) {
    throw std::invalid_argument("absolute pose: the initial pose or its prior is not finite");
  }
  const std::vector<Observation> observations = observe(correspondences, model);
  AbsolutePose result;
  result.T_camera_source = T_initial;
  const auto inliers = fit_to_inliers(observations, options, prior, result);
  result.num_inliers = static_cast<int>(inliers.size());
  if (!prior && (result.num_inliers < options.min_inliers ||
                 result.num_inliers <
                     options.min_inlier_ratio * static_cast<double>(correspondences.size()))) {
    return std::nullopt;
  }
  result.inliers.assign(correspondences.size(), 0);
  double sum_sq = 0;
  for (const Observation* observation : inliers) {
    result.inliers[static_cast<std::size_t>(observation->index)] = 1;
    sum_sq += sq_reprojection_error(*observation, result.T_camera_source);
  }
  result.rmse_px = std::sqrt(sum_sq / std::max(1, result.num_inliers));
  result.covariance = covariance(inliers, result.T_camera_source, options, prior);
  return result;
}

}  // namespace lidar_upsampling
