// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/motion_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "tracks/car_on_pictures.h"

namespace lidar_upsampling {
namespace {

using testing::ahead;
using testing::car;
using testing::kCentroid;
using testing::seen_on;
using testing::to_the_left;

MotionExpected anywhere(double sigma_m) {
  MotionExpected prior;
  prior.covariance.diagonal() << 1e-4, 1e-4, 1e-2, sigma_m * sigma_m, sigma_m * sigma_m, 1e-4;
  return prior;
}

Twist step(double x, double y) {
  Twist motion = Twist::Zero();
  motion[3] = x;
  motion[4] = y;
  return motion;
}

TEST(MotionFit, finds_the_motion_that_moved_the_points) {
  const Twist truth = step(-1, 0.4);
  ImageFactor image;
  image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen_on(ahead(), car(), truth));
  const MotionFit fit =
      fit_motion(image, kCentroid, anywhere(1.5), {truth, Twist::Zero()}, 0.5, {});
  EXPECT_LT((fit.mean - truth).norm(), 1e-2);
  EXPECT_EQ(fit.num_inliers, static_cast<int>(car().size()));
}

TEST(MotionFit, joins_what_two_cameras_see_of_one_object) {
  const Twist truth = step(0.6, -0.3);
  ImageFactor one, both;
  one.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen_on(ahead(), car(), truth));
  both = one;
  both.add({to_the_left(), 1, Eigen::Vector3d::Zero()}, seen_on(to_the_left(), car(), truth));
  const auto along = [&](const ImageFactor& image) {
    return std::sqrt(
        fit_motion(image, kCentroid, anywhere(1.5), {truth}, 0.5, {}).covariance(3, 3));
  };
  // Each sees well what is across its view.
  EXPECT_LT(along(both), 0.5 * along(one));
}

TEST(MotionFit, outweighs_a_prior_that_is_wrong) {
  ImageFactor image;
  image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen_on(ahead(), car(), Twist::Zero()));
  MotionExpected wrong = anywhere(0.3);
  wrong.mean[4] = 1;  // to the left
  const MotionFit fit = fit_motion(image, kCentroid, wrong, {wrong.mean, Twist::Zero()}, 0.5, {});
  EXPECT_NEAR(fit.mean[4], 0, 0.03);
}

TEST(MotionFit, is_not_led_astray_by_a_third_of_the_points) {
  const Twist truth = step(0, 0.5);
  auto seen = seen_on(ahead(), car(), truth);
  for (std::size_t i = 0; i < seen.size(); i += 3)
    seen[i].normalised += Eigen::Vector2d(0.05, 0.01);
  ImageFactor image;
  image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen);
  const MotionFit fit = fit_motion(image, kCentroid, anywhere(1.5), {truth}, 0.5, {});
  EXPECT_NEAR(fit.mean[4], 0.5, 0.02);
}

TEST(MotionFit, knows_that_the_points_lay_elsewhere_on_the_anchor_picture) {
  // The anchor was taken half way to the picture; until then the object moved as was assumed.
  const Twist truth = step(0, 0.6);
  ImageFactor image;
  image.add({ahead(), 0.5, {0, 0.3, 0}}, seen_on(ahead(), car(), truth));
  const MotionFit fit = fit_motion(image, kCentroid, anywhere(1.5), {Twist::Zero()}, 0.5, {});
  EXPECT_NEAR(fit.mean[4], 0.6, 0.02);
}

TEST(MotionFit, is_as_uncertain_as_it_says_over_many_noisy_pictures) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  PointNoise noise;
  noise.points_per_observation = 1;
  noise.degrees_of_freedom = 1000;  // of nearly normal noise, as is drawn here
  const MotionExpected prior = anywhere(0.5);
  constexpr int kTrials = 300;
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Twist truth;
    for (int i = 0; i < 6; ++i) truth[i] = std::sqrt(prior.covariance(i, i)) * normal(random);
    auto seen = seen_on(ahead(), car(), truth);
    for (Observation& observation : seen)
      observation.normalised += observation.pixel_by_normalised.inverse() *
                                Eigen::Vector2d(0.5 * normal(random), 0.5 * normal(random));
    ImageFactor image;
    image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen);
    const MotionFit fit = fit_motion(image, kCentroid, prior, {truth}, 0.5, noise);
    const Eigen::Vector3d error = (fit.mean - truth).tail<3>();
    sum += error.dot(Eigen::Matrix3d(fit.covariance.bottomRightCorner<3, 3>()).inverse() * error);
  }
  EXPECT_NEAR(sum / (3 * kTrials), 1, 4 * std::sqrt(2. / (3 * kTrials)));
}

TEST(FitWithScatter, prefers_the_motion_about_which_points_scatter_less) {
  // Half a pixel off is what is expected of any point, but none of these is off by that.
  const Twist truth = step(0, 0.02);
  ImageFactor image;
  image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen_on(ahead(), car(), truth));
  MotionExpected there, elsewhere = anywhere(1e-3);
  there = elsewhere;
  there.mean = truth;
  const auto evidence = [&](const MotionExpected& prior) {
    return fit_with_scatter(image, kCentroid, prior, {prior.mean}, {}).log_evidence;
  };
  const auto at_expected_scatter = [&](const MotionExpected& prior) {
    return fit_motion(image, kCentroid, prior, {prior.mean}, PointNoise().sigma_px, {})
        .log_evidence;
  };
  EXPECT_GT(evidence(there) - evidence(elsewhere),
            2 * (at_expected_scatter(there) - at_expected_scatter(elsewhere)));
}

TEST(PointScatter, is_measured_on_the_points) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  auto seen = seen_on(ahead(), car(), Twist::Zero());
  for (Observation& observation : seen)
    observation.normalised += observation.pixel_by_normalised.inverse() *
                              Eigen::Vector2d(1.5 * normal(random), 1.5 * normal(random));
  ImageFactor image;
  image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen);
  PointNoise noise;
  noise.degrees_of_freedom = 1000;
  EXPECT_NEAR(measured_sigma_px(image, kCentroid, Twist::Zero(), noise), 1.5, 0.25);
}

}  // namespace
}  // namespace lidar_upsampling
