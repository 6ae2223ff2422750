// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/absolute_pose.h"

#include <gtest/gtest.h>

#include <limits>

#include "pose_problems.h"

namespace lidar_upsampling {
namespace {

PoseProblem with_lens(DistortionModel kind, const std::array<double, 8>& distortion) {
  PoseProblem problem;
  problem.model.distortion_model = kind;
  problem.model.distortion = distortion;
  return problem;
}

TEST(AbsolutePose, is_exact_without_noise) {
  for (const PoseProblem& lens :
       {PoseProblem{}, with_lens(DistortionModel::plumb_bob, {-0.37, 0.2, 2e-3, 1e-3, -0.07}),
        with_lens(DistortionModel::kannala_brandt, {-0.02, 0.01, 0, 0, -0.008, 0.0015})}) {
    const PoseProblem problem = make_pose_problem({}, lens);
    const auto pose = estimate_absolute_pose(problem.correspondences, problem.model);
    ASSERT_TRUE(pose);
    EXPECT_LT((pose->T_camera_source.matrix() - problem.truth.matrix()).norm(), 1e-7);
    EXPECT_EQ(pose->num_inliers, 100);
    EXPECT_LT(pose->rmse_px, 1e-6);
    EXPECT_TRUE(pose->converged);
  }
}

TEST(AbsolutePose, outliers_are_told_from_inliers_and_do_not_harm) {
  double sum_error = 0;
  constexpr int kNumTrials = 20;
  for (int trial = 0; trial < kNumTrials; ++trial) {
    ProblemOptions options;
    options.noise_px = 0.3;
    options.outliers = 0.4;
    options.seed = static_cast<std::uint32_t>(trial);
    const PoseProblem problem = make_pose_problem(options);
    const auto pose = estimate_absolute_pose(problem.correspondences, problem.model);
    ASSERT_TRUE(pose);
    int num_wrong = 0;
    for (std::size_t i = 0; i < problem.is_outlier.size(); ++i) {
      num_wrong += (pose->inliers[i] != 0) == problem.is_outlier[i] ? 1 : 0;
    }
    EXPECT_LE(num_wrong, 2);
    EXPECT_LT(pose->rmse_px, 0.6);
    EXPECT_LT(position_error(problem, pose->T_camera_source), 0.15);
    sum_error += position_error(problem, pose->T_camera_source);
  }
  EXPECT_LT(sum_error / kNumTrials, 0.05);
}

TEST(AbsolutePose, survives_seventy_percent_outliers) {
  ProblemOptions options;
  options.noise_px = 0.3;
  options.outliers = 0.7;
  const PoseProblem problem = make_pose_problem(options);
  AbsolutePoseOptions pose_options;
  pose_options.min_inlier_ratio = 0.2;
  const auto pose = estimate_absolute_pose(problem.correspondences, problem.model, pose_options);
  ASSERT_TRUE(pose);
  EXPECT_LT(position_error(problem, pose->T_camera_source), 0.15);
}

TEST(AbsolutePose, the_same_seed_gives_the_same_result) {
  ProblemOptions options;
  options.noise_px = 0.5;
  options.outliers = 0.4;
  const PoseProblem problem = make_pose_problem(options);
  const auto first = estimate_absolute_pose(problem.correspondences, problem.model);
  const auto second = estimate_absolute_pose(problem.correspondences, problem.model);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_camera_source.matrix(), second->T_camera_source.matrix());
  EXPECT_EQ(first->inliers, second->inliers);
  EXPECT_EQ(first->covariance, second->covariance);
}

TEST(AbsolutePose, a_good_initial_pose_makes_up_for_lack_of_samples) {
  ProblemOptions options;
  options.noise_px = 0.2;
  options.outliers = 0.6;
  const PoseProblem problem = make_pose_problem(options);
  AbsolutePoseOptions one_sample;
  one_sample.ransac.min_iterations = one_sample.ransac.max_iterations = 1;
  const auto without = estimate_absolute_pose(problem.correspondences, problem.model, one_sample);
  EXPECT_TRUE(!without || position_error(problem, without->T_camera_source) > 0.3);
  const auto with =
      estimate_absolute_pose(problem.correspondences, problem.model, one_sample, problem.truth);
  ASSERT_TRUE(with);
  EXPECT_LT(position_error(problem, with->T_camera_source), 0.1);
}

TEST(AbsolutePose, a_wrong_initial_pose_is_overruled) {
  const PoseProblem problem = make_pose_problem({});
  Pose wrong = problem.truth;
  wrong.translation().x() += 2;
  const auto pose = estimate_absolute_pose(problem.correspondences, problem.model, {}, wrong);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->T_camera_source.matrix() - problem.truth.matrix()).norm(), 1e-6);
}

TEST(AbsolutePose, pixels_without_a_common_motion_give_none) {
  ProblemOptions options;
  options.outliers = 1;
  const PoseProblem problem = make_pose_problem(options);
  EXPECT_FALSE(estimate_absolute_pose(problem.correspondences, problem.model));
}

TEST(AbsolutePose, too_few_correspondences_give_none) {
  ProblemOptions options;
  options.num_points = 7;
  const PoseProblem problem = make_pose_problem(options);
  EXPECT_FALSE(estimate_absolute_pose(problem.correspondences, problem.model));
  EXPECT_FALSE(estimate_absolute_pose({}, problem.model));
}

TEST(AbsolutePose, wrong_input_is_refused) {
  PoseProblem problem = make_pose_problem({});
  AbsolutePoseOptions options;
  options.sigma_px = 0;
  EXPECT_THROW((void)estimate_absolute_pose(problem.correspondences, problem.model, options),
               std::invalid_argument);
  options = {};
  options.min_inliers = 3;
  EXPECT_THROW((void)estimate_absolute_pose(problem.correspondences, problem.model, options),
               std::invalid_argument);
  EXPECT_THROW((void)estimate_absolute_pose(problem.correspondences, CameraModel{}),
               std::invalid_argument);
  problem.correspondences[5].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)estimate_absolute_pose(problem.correspondences, problem.model),
               std::invalid_argument);
}

TEST(ReprojectionErrors, are_pixel_distances_and_infinite_behind_the_camera) {
  PoseProblem problem =
      make_pose_problem({}, with_lens(DistortionModel::plumb_bob, {-0.37, 0.2, 2e-3, 1e-3, -0.07}));
  problem.correspondences[0].pixel += Eigen::Vector2d(3, -4);
  problem.correspondences[1].point_in_source.x() = -20;
  const auto errors = reprojection_errors(problem.correspondences, problem.model, problem.truth);
  EXPECT_NEAR(errors[0], 5, 1e-9);
  EXPECT_EQ(errors[1], std::numeric_limits<double>::infinity());
  EXPECT_LT(errors[2], 1e-9);
}

}  // namespace
}  // namespace lidar_upsampling
