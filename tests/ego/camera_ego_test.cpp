// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/camera_ego.h"

#include <gtest/gtest.h>

#include <random>

#include "drive.h"
#include "lidar_upsampling/vision/projection.h"
#include "street.h"

namespace lidar_upsampling {
namespace {

using testing::angle_between;
using testing::lidar_at;
using testing::translation_between;

CameraModel wide_picture() {
  CameraModel model;
  model.width = 1242;
  model.height = 375;
  model.fx = model.fy = 721;
  model.cx = 609;
  model.cy = 172;
  return model;
}

Pose camera_on_roof() {
  Pose T_lidar_camera = Pose::Identity();
  T_lidar_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_lidar_camera.translation() = Eigen::Vector3d(0.3, 0, -0.1);
  return T_lidar_camera.inverse();
}

struct TrackedStreet {
  std::vector<Correspondence> correspondences;
  int num_outliers = 0;
};

/// Every stride-th point of a street scan, seen after `motion` with pixel noise; `outlier_share` of
/// them are moved in space by `outlier_motion` before.
TrackedStreet track_street(const Pose& motion, double noise_px, double outlier_share,
                           const Pose& outlier_motion) {
  const LidarScan scan = testing::scan_street(testing::houses(), lidar_at(0, 0, 0), 1, nullptr, 64);
  const auto visible = project_scan(wide_picture(), camera_on_roof(), scan.points);
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> any(0, 1);
  TrackedStreet result;
  for (std::size_t i = 0; i < visible.size(); i += visible.size() / 300) {
    const Eigen::Vector3d point = scan.points[visible[i].index].cast<double>();
    const bool is_outlier = any(random) < outlier_share;
    const Pose moved = is_outlier ? motion * outlier_motion : motion;
    const auto pixel = project(wide_picture(), camera_on_roof() * moved * point);
    if (pixel) {
      result.correspondences.push_back(
          {point, *pixel + Eigen::Vector2d(noise_px * noise(random), noise_px * noise(random))});
      result.num_outliers += is_outlier ? 1 : 0;
    }
  }
  return result;
}

TEST(CameraEgo, is_found_among_thirty_percent_moving_outliers_without_any_guess) {
  const Pose truth = lidar_at(1.0, 0.05, 0.03).inverse() * lidar_at(0, 0, 0);
  Pose oncoming = Pose::Identity();
  oncoming.translation() = Eigen::Vector3d(-1.5, 0, 0);
  const TrackedStreet street = track_street(truth, 0.4, 0.3, oncoming);
  const auto ego = estimate_camera_ego(street.correspondences, wide_picture(), camera_on_roof(), {},
                                       Pose::Identity());
  ASSERT_TRUE(ego);
  EXPECT_LT(translation_between(ego->T_to_from, truth), 0.02);
  EXPECT_LT(angle_between(ego->T_to_from, truth), 0.001);
}

TEST(CameraEgo, error_is_within_what_its_covariance_says) {
  const Pose truth = lidar_at(0.8, 0, 0.01).inverse() * lidar_at(0, 0, 0);
  const TrackedStreet street =
      track_street(truth, 0.5, 0.1, lidar_at(2, 0, 0) * lidar_at(0, 0, 0).inverse());
  const auto ego =
      estimate_camera_ego(street.correspondences, wide_picture(), camera_on_roof(), {}, truth);
  ASSERT_TRUE(ego);
  const Twist error = log_se3(ego->T_to_from * truth.inverse());
  EXPECT_LT(error.dot(ego->covariance.ldlt().solve(error)),
            22.5);  // 99.9 % of chi-square, 6 d.o.f.
  EXPECT_LT(std::sqrt(ego->covariance(3, 3)), 0.03);
}

TEST(CameraEgo, a_guess_holds_what_few_points_cannot) {
  const Pose truth = lidar_at(0.8, 0, 0.01).inverse() * lidar_at(0, 0, 0);
  TrackedStreet street = track_street(truth, 0.8, 0, Pose::Identity());
  std::vector<Correspondence> few;
  for (std::size_t i = 0; i < street.correspondences.size(); i += 9) {
    few.push_back(street.correspondences[i]);
  }
  CameraEgoOptions loose;
  loose.sigmas << 10, 10, 10, 100, 100, 100;
  const auto with_prior = estimate_camera_ego(few, wide_picture(), camera_on_roof(), {}, truth);
  const auto without = estimate_camera_ego(few, wide_picture(), camera_on_roof(), loose, truth);
  ASSERT_TRUE(with_prior && without);
  EXPECT_LT(translation_between(with_prior->T_to_from, truth),
            translation_between(without->T_to_from, truth));
}

TEST(CameraEgo, a_handful_of_points_betters_a_guess_that_knows_its_own_error) {
  const Pose truth = lidar_at(0.8, 0, 0.01).inverse() * lidar_at(0, 0, 0);
  const Pose guess = lidar_at(1.0, 0, 0.01).inverse() * lidar_at(0, 0, 0);
  TrackedStreet street = track_street(truth, 0.3, 0, Pose::Identity());
  std::vector<Correspondence> few;
  for (std::size_t i = 0; i < street.correspondences.size(); i += 25)
    few.push_back(street.correspondences[i]);
  ASSERT_LT(few.size(), 20U);
  CameraEgoOptions options;
  EXPECT_FALSE(estimate_camera_ego(few, wide_picture(), camera_on_roof(), options, guess));
  options.trust_guess = true;
  options.guess_covariance = Matrix6d(1e-6 * Matrix6d::Identity());
  options.guess_covariance->bottomRightCorner<3, 3>() *= 4e4;  // 0.2 m
  const auto ego = estimate_camera_ego(few, wide_picture(), camera_on_roof(), options, guess);
  ASSERT_TRUE(ego);
  EXPECT_LT(translation_between(ego->T_to_from, truth), 0.05);
}

TEST(CameraEgo, there_is_none_of_a_handful_of_points_nor_of_noise) {
  TrackedStreet street = track_street(Pose::Identity(), 0.4, 0, Pose::Identity());
  std::mt19937 random(9);
  std::uniform_real_distribution<double> anywhere(0, 375);
  auto noise = street.correspondences;
  for (auto& correspondence : noise) {
    correspondence.pixel = {3 * anywhere(random), anywhere(random)};
  }
  EXPECT_FALSE(estimate_camera_ego(noise, wide_picture(), camera_on_roof(), {}, Pose::Identity()));
  street.correspondences.resize(15);
  EXPECT_FALSE(estimate_camera_ego(street.correspondences, wide_picture(), camera_on_roof(), {},
                                   Pose::Identity()));
}

}  // namespace
}  // namespace lidar_upsampling
