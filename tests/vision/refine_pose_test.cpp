// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/refine_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/vision/observation.h"
#include "pose_problems.h"

namespace lidar_upsampling {
namespace {

/// (w, t) in truth = [exp(w) | t] * estimate.
Twist error_of(const Pose& truth, const Pose& estimate) {
  const Pose increment = truth * estimate.inverse();
  Twist error;
  error << rotation_log(increment.linear()), increment.translation();
  return error;
}

TEST(PoseIncrement, the_log_inverts_the_exp) {
  for (const double scale : {1e-13, 1e-6, 0.1, 2.5}) {
    const Eigen::Vector3d w = scale * Eigen::Vector3d(0.5, -0.7, 0.3);
    EXPECT_LT((rotation_log(rotation_exp(w)) - w).norm(), 1e-8 * scale + 1e-15);
  }
}

TEST(PoseIncrement, the_left_jacobian_agrees_with_differences) {
  const Eigen::Vector3d w(0.3, -0.8, 0.5);
  const Eigen::Matrix3d jacobian = left_jacobian(w);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d change =
        rotation_log(rotation_exp(w + step) * rotation_exp(w - step).transpose());
    EXPECT_LT((change / 2e-6 - jacobian.col(axis)).norm(), 1e-7);
  }
}

TEST(PoseIncrement, the_reprojection_jacobian_agrees_with_differences) {
  const PoseProblem problem = make_pose_problem({});
  const auto observations = observe(problem.correspondences, problem.model);
  const auto at = reprojection(observations[3], problem.truth);
  ASSERT_TRUE(at);
  for (int axis = 0; axis < 6; ++axis) {
    const Twist step = 1e-6 * Twist::Unit(axis);
    const auto plus = reprojection(observations[3], incremented(step, problem.truth));
    const auto minus = reprojection(observations[3], incremented(-step, problem.truth));
    EXPECT_LT(((plus->residual - minus->residual) / 2e-6 - at->jacobian.col(axis)).norm(), 1e-4);
  }
}

TEST(RefinePose, a_start_some_pixels_off_ends_at_the_truth_despite_outliers) {
  ProblemOptions options;
  options.outliers = 0.2;
  const PoseProblem problem = make_pose_problem(options);
  Twist offset;
  offset << 0.002, -0.003, 0.004, 0.02, -0.01, 0.1;
  const auto pose = refine_absolute_pose(problem.correspondences, problem.model,
                                         incremented(offset, problem.truth));
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->converged);
  EXPECT_EQ(pose->num_inliers, 80);
  EXPECT_LT(error_of(problem.truth, pose->T_camera_source).norm(), 1e-6);
}

TEST(RefinePose, a_start_without_support_gives_none) {
  const PoseProblem problem = make_pose_problem({});
  Pose far = problem.truth;
  far.translation().x() += 5;
  EXPECT_FALSE(refine_absolute_pose(problem.correspondences, problem.model, far));
}

TEST(RefinePose, the_covariance_is_that_of_repeated_estimates) {
  for (const double noise_px : {0.15, 0.4}) {
    constexpr int kNumTrials = 400;
    Matrix6d scatter = Matrix6d::Zero();
    Matrix6d predicted = Matrix6d::Zero();
    double mean_sq_mahalanobis = 0;
    const PoseProblem clean = make_pose_problem({});
    std::mt19937 generator(21);
    std::normal_distribution<double> noise(0, noise_px);
    for (int trial = 0; trial < kNumTrials; ++trial) {
      PoseProblem problem = clean;
      for (auto& correspondence : problem.correspondences) {
        correspondence.pixel += Eigen::Vector2d(noise(generator), noise(generator));
      }
      const auto pose = refine_absolute_pose(problem.correspondences, problem.model, problem.truth);
      ASSERT_TRUE(pose);
      const Twist error = error_of(problem.truth, pose->T_camera_source);
      scatter += error * error.transpose() / kNumTrials;
      predicted += pose->covariance / kNumTrials;
      mean_sq_mahalanobis += error.dot(pose->covariance.ldlt().solve(error)) / kNumTrials;
    }
    // 6 if consistent; its standard deviation over so many trials is 0.17.
    EXPECT_NEAR(mean_sq_mahalanobis, 6, 0.9);
    for (int axis = 0; axis < 6; ++axis) {
      EXPECT_NEAR(std::sqrt(predicted(axis, axis) / scatter(axis, axis)), 1, 0.15) << axis;
    }
  }
}

TEST(RefinePose, a_strong_prior_holds_and_a_weak_one_does_not_matter) {
  ProblemOptions options;
  options.num_points = 20;
  options.noise_px = 0.3;
  const PoseProblem problem = make_pose_problem(options);
  PosePrior prior;
  Twist offset;
  offset << 0, 0, 0, 0, 0, 0.05;
  prior.T_mean = incremented(offset, problem.truth);
  prior.sqrt_information = 1e6 * Matrix6d::Identity();
  const auto held =
      refine_absolute_pose(problem.correspondences, problem.model, problem.truth, {}, prior);
  ASSERT_TRUE(held);
  EXPECT_LT(error_of(prior.T_mean, held->T_camera_source).norm(), 1e-4);
  prior.sqrt_information = 1e-4 * Matrix6d::Identity();
  const auto free =
      refine_absolute_pose(problem.correspondences, problem.model, problem.truth, {}, prior);
  const auto without = refine_absolute_pose(problem.correspondences, problem.model, problem.truth);
  ASSERT_TRUE(free && without);
  EXPECT_LT(error_of(without->T_camera_source, free->T_camera_source).norm(), 1e-4);
}

TEST(RefinePose, a_prior_lends_what_few_points_lack) {
  ProblemOptions options;
  options.num_points = 10;
  options.noise_px = 0.3;
  options.distance = 40;
  double sum_without = 0;
  double sum_with = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    options.seed = seed;
    const PoseProblem problem = make_pose_problem(options);
    std::mt19937 generator(100 + seed);
    std::normal_distribution<double> noise(0, 1);
    Twist offset;
    for (int i = 0; i < 6; ++i) offset[i] = (i < 3 ? 0.002 : 0.02) * noise(generator);
    PosePrior prior;
    prior.T_mean = incremented(offset, problem.truth);
    prior.sqrt_information.diagonal() << 500, 500, 500, 50, 50, 50;
    const auto without =
        refine_absolute_pose(problem.correspondences, problem.model, problem.truth);
    const auto with =
        refine_absolute_pose(problem.correspondences, problem.model, problem.truth, {}, prior);
    ASSERT_TRUE(without && with);
    sum_without += position_error(problem, without->T_camera_source);
    sum_with += position_error(problem, with->T_camera_source);
    EXPECT_LT(with->covariance.trace(), without->covariance.trace());
  }
  EXPECT_LT(sum_with, 0.3 * sum_without);
}

TEST(RefinePose, without_correspondences_the_prior_is_the_answer) {
  PosePrior prior;
  prior.T_mean.translation() << 1, 2, 3;
  prior.sqrt_information = 10 * Matrix6d::Identity();
  const auto pose =
      refine_absolute_pose({}, make_pose_problem({}).model, Pose::Identity(), {}, prior);
  ASSERT_TRUE(pose);
  EXPECT_LT(error_of(prior.T_mean, pose->T_camera_source).norm(), 1e-6);
  EXPECT_EQ(pose->num_inliers, 0);
  EXPECT_NEAR(pose->covariance(4, 4), 0.01, 1e-6);
}

TEST(RefinePose, what_is_not_finite_is_refused) {
  const PoseProblem problem = make_pose_problem({});
  Pose broken = problem.truth;
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)refine_absolute_pose(problem.correspondences, problem.model, broken),
               std::invalid_argument);
  PosePrior prior;
  prior.T_mean = broken;
  EXPECT_THROW(
      (void)refine_absolute_pose(problem.correspondences, problem.model, problem.truth, {}, prior),
      std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
