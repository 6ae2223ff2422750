// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/track_state.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "tracks/car_on_pictures.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;

TrackState state_of(double vx, double vy, double yaw_rate) {
  TrackState state;
  state.stamp = kStart;
  state.mean << 0, 0, 0, vx, vy, yaw_rate, 0, 0;
  return state;
}

PlanarStep seen_at(double x, double y, double sigma_m) {
  PlanarStep step;
  step.mean << x, y, 0;
  step.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, 1;
  return step;
}

TEST(TrackState, goes_straight_on_at_constant_velocity) {
  const TrackState later = predicted(state_of(10, -2, 0), shifted(kStart, 0.5), {});
  EXPECT_NEAR(later.mean[0], 5, 1e-9);
  EXPECT_NEAR(later.mean[1], -1, 1e-9);
  EXPECT_EQ(later.velocity(), Eigen::Vector2d(10, -2));
}

TEST(TrackState, goes_around_a_circle_at_constant_turn_rate) {
  // A quarter of a circle of 10 m radius to the left, at 10 m/s.
  const TrackState later = predicted(state_of(10, 0, 1), shifted(kStart, M_PI / 2), {});
  EXPECT_NEAR(later.mean[0], 10, 1e-6);
  EXPECT_NEAR(later.mean[1], 10, 1e-6);
  EXPECT_NEAR(later.mean[2], M_PI / 2, 1e-6);
  EXPECT_NEAR(later.mean[3], 0, 1e-5);
  EXPECT_NEAR(later.mean[4], 10, 1e-5);
}

TEST(TrackState, brakes_on_while_its_acceleration_lasts) {
  MotionNoise noise;
  noise.acceleration_time = 1e3;
  TrackState state = state_of(10, 0, 0);
  state.mean[6] = -4;
  const TrackState steady = predicted(state, shifted(kStart, 0.5), noise);
  EXPECT_NEAR(steady.mean[0], 10 * 0.5 - 0.5 * 4 * 0.25, 1e-3);
  EXPECT_NEAR(steady.velocity().x(), 8, 1e-2);
  noise.acceleration_time = 0.01;
  EXPECT_NEAR(predicted(state, shifted(kStart, 0.5), noise).velocity().x(), 9.96, 1e-6);
}

TEST(TrackState, learns_its_acceleration_from_sight_to_sight) {
  TrackState state = new_track_state(kStart, {});
  for (int i = 1; i <= 12; ++i) {
    const double t = 0.1 * i, step = 1 - 0.6 * (t * t - (t - 0.1) * (t - 0.1)) / 0.2;
    state = updated(predicted(from_here(state), shifted(kStart, t), {}), seen_at(step, 0, 0.005));
  }
  EXPECT_NEAR(state.velocity().x(), 10 - 6 * 1.2, 0.1);
  EXPECT_NEAR(state.mean[6], -6, 0.6);
}

TEST(TrackState, grows_as_uncertain_in_many_small_steps_as_in_a_large_one) {
  TrackState state = new_track_state(kStart, {});
  const TrackState at_once = predicted(state, shifted(kStart, 0.4), {});
  for (int i = 1; i <= 8; ++i) state = predicted(state, shifted(kStart, 0.05 * i), {});
  EXPECT_TRUE(state.covariance.isApprox(at_once.covariance, 1e-9));
}

TEST(TrackState, does_not_go_back_in_time) {
  const TrackState earlier = predicted(state_of(10, 0, 0), shifted(kStart, -0.1), {});
  EXPECT_EQ(earlier.stamp, kStart);
  EXPECT_EQ(earlier.mean[0], 0);
}

TEST(TrackState, learns_its_velocity_from_one_step) {
  const TrackState before = predicted(new_track_state(kStart, {}), shifted(kStart, 0.1), {});
  const TrackState after = updated(before, seen_at(3, -1, 0.02));
  EXPECT_NEAR(after.velocity().x(), 30, 0.2);
  EXPECT_NEAR(after.velocity().y(), -10, 0.1);
  EXPECT_LT(std::sqrt(after.covariance(3, 3)), 0.5);
}

TEST(TrackState, follows_a_step_far_off_less_where_a_few_points_have_told_it) {
  const TrackState state = predicted(state_of(10, 0, 0), shifted(kStart, 0.1), {});
  PlanarStep far_off;
  far_off.mean << state.mean[0] + 1, state.mean[1], 0;
  far_off.covariance.diagonal().setConstant(0.01);
  PlanarStep by_few = far_off, near = by_few;
  by_few.degrees_of_freedom = near.degrees_of_freedom = 2;
  near.mean[0] = state.mean[0] + 0.1;
  const auto gain = [&](const PlanarStep& step) {
    return (updated(state, step).mean[0] - state.mean[0]) / (step.mean[0] - state.mean[0]);
  };
  EXPECT_LT(gain(by_few), 0.7 * gain(far_off));
  EXPECT_NEAR(gain(near), gain(far_off), 0.01 * gain(far_off));
}

TEST(TrackState, is_likelier_far_away_where_its_scale_is_little_known) {
  const Eigen::Matrix2d scale = Eigen::Vector2d(0.04, 0.01).asDiagonal();
  const Eigen::Vector2d far(0.8, 0), near(0.1, 0.05);
  EXPECT_NEAR(student_density(near, scale, 1e6), gaussian_density(near, scale), 1e-4);
  EXPECT_GT(student_density(far, scale, 2), 10 * gaussian_density(far, scale));
  double sum = 0;
  constexpr double kStep_m = 0.02, kReach_m = 10;
  for (double x = -kReach_m; x < kReach_m; x += kStep_m)
    for (double y = -kReach_m; y < kReach_m; y += kStep_m)
      sum += student_density({x, y}, scale, 3) * kStep_m * kStep_m;
  EXPECT_NEAR(sum, 1, 0.01);
}

TEST(TrackState, takes_a_finished_estimate_as_it_takes_a_measurement) {
  const TrackState before = predicted(new_track_state(kStart, {}), shifted(kStart, 0.1), {});
  const TrackState measured = updated(before, seen_at(1, 0.2, 0.1));
  const TrackState told = updated(before, before.step(), measured.step());
  EXPECT_TRUE(told.mean.isApprox(measured.mean, 1e-9));
  EXPECT_TRUE(told.covariance.isApprox(measured.covariance, 1e-6));
}

TEST(TrackState, counts_steps_from_where_it_is_seen_anew) {
  TrackState state = predicted(state_of(10, 0, 0), shifted(kStart, 0.1), {});
  state = from_here(state);
  EXPECT_TRUE(state.mean.head<3>().isZero());
  EXPECT_TRUE(state.covariance.topRows<3>().isZero());
  EXPECT_EQ(state.velocity(), Eigen::Vector2d(10, 0));
}

TEST(TrackState, along_a_road_may_be_as_fast_as_any_but_goes_little_aside) {
  const MotionNoise noise;
  const TrackState any = new_track_state(kStart, noise);
  const Eigen::Matrix2d of_velocity = going_along(any, 0.3, noise).covariance.block<2, 2>(3, 3);
  const Eigen::Vector2d along(std::cos(0.3), std::sin(0.3)), aside(-along.y(), along.x());
  EXPECT_NEAR(along.dot(of_velocity * along), any.covariance(3, 3), 1e-9);
  EXPECT_NEAR(aside.dot(of_velocity * aside), std::pow(noise.slow_speed_sigma, 2), 1e-9);
}

TEST(TrackState, is_no_other_where_what_comes_is_as_predicted) {
  const TrackState now = predicted(new_track_state(kStart, {}), shifted(kStart, 0.1), {});
  const TrackState same = smoothed(now, predicted(now, shifted(kStart, 0.2), {}), {});
  EXPECT_TRUE(same.mean.isApprox(now.mean, 1e-9));
  EXPECT_TRUE(same.covariance.isApprox(now.covariance, 1e-6));
}

TEST(TrackState, is_pulled_to_what_a_later_sight_tells) {
  const TrackState start = new_track_state(kStart, {});
  const TrackState later = updated(predicted(start, shifted(kStart, 0.1), {}), seen_at(1, 0, 0.01));
  const TrackState halfway = smoothed(predicted(start, shifted(kStart, 0.05), {}), later, {});
  EXPECT_NEAR(halfway.mean.x(), 0.5, 0.01);
  EXPECT_NEAR(halfway.velocity().x(), 10, 0.1);
  EXPECT_LT(std::sqrt(halfway.covariance(0, 0)), 0.05);
}

TEST(TrackState, learns_its_step_from_its_velocity) {
  TrackState state = predicted(new_track_state(kStart, {}), shifted(kStart, 0.1), {});
  TrackState known = state;
  known.mean[3] = 10;
  known.covariance.bottomRightCorner<5, 5>() *= 1e-4;
  state = with_velocity(state, known);
  EXPECT_NEAR(state.mean.x(), 1, 0.02);
  EXPECT_LT(std::sqrt(state.covariance(0, 0)), 0.1);
}

// One object's drawn life: an acceleration that lasts a while, a sight every tenth of a second.
double sq_velocity_error_in_sigmas(std::mt19937& random, const MotionNoise& noise) {
  std::normal_distribution<double> normal;
  constexpr double kSight_m = 0.03, kStep_s = 0.1;
  constexpr int kFine = 20;
  Eigen::Vector2d velocity(noise.unknown_speed_sigma * normal(random),
                           noise.unknown_speed_sigma * normal(random));
  const auto draw = [&] { return Eigen::Vector2d(normal(random), normal(random)); };
  Eigen::Vector2d acceleration = noise.acceleration_sigma * draw();
  TrackState state = new_track_state(kStart, noise);
  for (int scan = 1; scan <= 6; ++scan) {
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    const double dt = kStep_s / kFine;
    for (int i = 0; i < kFine; ++i) {
      step += velocity * dt;
      velocity += acceleration * dt;
      const double lasts = std::exp(-dt / noise.acceleration_time);
      acceleration =
          lasts * acceleration + noise.acceleration_sigma * std::sqrt(1 - lasts * lasts) * draw();
    }
    const Stamp now = shifted(kStart, kStep_s * scan);
    state = updated(predicted(state, now, noise),
                    seen_at(step.x() + kSight_m * normal(random),
                            step.y() + kSight_m * normal(random), kSight_m));
    if (scan < 6) state = from_here(state);
  }
  const Eigen::Vector2d error = state.velocity() - velocity;
  return error.dot(Eigen::Matrix2d(state.covariance.block<2, 2>(3, 3)).inverse() * error);
}

TEST(TrackState, is_as_uncertain_as_it_says_over_many_drawn_lives) {
  MotionNoise noise;
  noise.unknown_yaw_rate_sigma = noise.yaw_acceleration = 1e-6;
  std::mt19937 random(1);
  constexpr int kLives = 1000;
  double sum = 0;
  for (int i = 0; i < kLives; ++i) sum += sq_velocity_error_in_sigmas(random, noise);
  // A chi-square of 2 kLives degrees of freedom: within four of its deviations.
  EXPECT_NEAR(sum / (2 * kLives), 1, 4 * std::sqrt(1. / kLives));
}

}  // namespace
}  // namespace lidar_upsampling
