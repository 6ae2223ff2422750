// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/ego_fusion.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "drive.h"

namespace lidar_upsampling {
namespace {

const Eigen::Vector3d kStanding = Eigen::Vector3d::Zero();

Twist sigmas(double turn_rad, double step_m) {
  Twist result;
  result << turn_rad, turn_rad, turn_rad, step_m, step_m, step_m;
  return result;
}

Twist drawn(std::mt19937& random, const Twist& sigma) {
  std::normal_distribution<double> normal;
  Twist result;
  for (double& value : result) value = normal(random);
  return result.cwiseProduct(sigma);
}

EgoStep wrong_by(const Pose& truth, const Twist& error, const Twist& sigma) {
  EgoStep step;
  step.T_to_from = exp_se3(error) * truth;
  step.covariance = sigma.cwiseAbs2().asDiagonal();
  return step;
}

EgoStep taken(const EgoStep& step, const Twist& variance) {
  EgoStep result = step;
  result.covariance = variance.asDiagonal();
  return result;
}

// What registration of simulated streets is wrong by, and what it says it is.
const Twist kRegistration = (Twist() << 1e-4, 1e-4, 5e-5, 0.015, 0.001, 0.001).finished();
const Twist kBelieved = (Twist() << 2e-4, 2e-4, 1e-4, 0.02, 0.002, 0.002).finished();
const Pose kStep = testing::Drive{10, 0.2}.step(0, 0.1);

PoseNoise after(int num_steps, const Twist& poses_sigma, unsigned seed) {
  std::mt19937 random(seed);
  PoseNoise noise;
  for (int i = 0; i < num_steps; ++i)
    note_step(noise, wrong_by(kStep, drawn(random, poses_sigma), Twist::Zero()),
              wrong_by(kStep, drawn(random, kRegistration), kBelieved));
  return noise;
}

TEST(EgoFusion, exact_poses_are_followed_to_the_digit_from_the_first_registration_on) {
  const Twist usual = usual_noise(EgoSource::poses, {10, 0, 0});
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Twist variance =
        likely_noise(after(1 + static_cast<int>(seed), Twist::Zero(), seed), usual);
    EXPECT_TRUE(variance.isZero(0)) << variance.transpose();
    std::mt19937 random(seed);
    const EgoStep registered = wrong_by(kStep, drawn(random, kRegistration), kBelieved);
    const EgoStep joined = fused(wrong_by(kStep, Twist::Zero(), Twist::Zero()), registered);
    EXPECT_EQ(joined.T_to_from.matrix(), kStep.matrix());
    EXPECT_TRUE(joined.covariance.isZero(0));
  }
}

TEST(EgoFusion, a_weak_axis_of_registration_does_not_speak_against_exact_poses) {
  // Sixteen rings on level ground: pitch is wrong by 0.7 mrad, every time.
  const Twist bias = (Twist() << 0, 7e-4, 0, 0, 0, 0).finished();
  std::mt19937 random(4);
  PoseNoise noise;
  for (int i = 0; i < 10; ++i) {
    note_step(noise, wrong_by(kStep, Twist::Zero(), Twist::Zero()),
              wrong_by(kStep, bias + drawn(random, kRegistration), kBelieved));
    EXPECT_TRUE(likely_noise(noise, usual_noise(EgoSource::poses, {10, 0, 0})).isZero(0));
  }
}

TEST(EgoFusion, a_direction_in_which_one_is_exact_is_followed) {
  std::mt19937 random(3);
  Twist sigma = sigmas(0.001, 0.03);
  sigma[3] = 0;
  const EgoStep a = wrong_by(kStep, Twist::Zero(), sigma);
  const EgoStep b = wrong_by(kStep, drawn(random, kBelieved), kBelieved);
  const Twist off = log_se3(fused(a, b).T_to_from * kStep.inverse());
  EXPECT_NEAR(off[3], 0, 1e-12);
  EXPECT_GT(std::abs(off[4]), 1e-5);
  const Twist again = log_se3(fused(b, a).T_to_from * kStep.inverse());
  EXPECT_NEAR(again[3], 0, 1e-6);
}

TEST(EgoFusion, noise_of_the_poses_is_found) {
  const Twist truth = sigmas(0.001, 0.03), usual = usual_noise(EgoSource::poses, kStanding);
  Twist mean = Twist::Zero();
  constexpr int kTrials = 100;
  for (unsigned seed = 0; seed < kTrials; ++seed)
    mean += likely_noise(after(20, truth, seed), usual) / kTrials;
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_GT(std::sqrt(mean[axis]), 0.9 * truth[axis]) << axis;
    EXPECT_LT(std::sqrt(mean[axis]), 1.3 * truth[axis]) << axis;  // the worse of axis and kind
  }
}

TEST(EgoFusion, noisy_poses_are_outweighed) {
  const Twist sigma = sigmas(0.001, 0.05);
  const Twist variance =
      likely_noise(after(10, sigma, 7), usual_noise(EgoSource::poses, kStanding));
  std::mt19937 random(8);
  double sq_alone = 0, sq_joined = 0;
  for (int i = 0; i < 200; ++i) {
    const EgoStep given = wrong_by(kStep, drawn(random, sigma), sigma);
    const EgoStep registered = wrong_by(kStep, drawn(random, kRegistration), kBelieved);
    const EgoStep joined = fused(taken(given, variance), registered);
    sq_alone += log_se3(given.T_to_from * kStep.inverse()).tail<3>().squaredNorm();
    sq_joined += log_se3(joined.T_to_from * kStep.inverse()).tail<3>().squaredNorm();
  }
  EXPECT_LT(sq_joined, 0.04 * sq_alone);
}

TEST(EgoFusion, poses_that_lag_are_outweighed_where_they_are_wrong) {
  // A vehicle that brakes and turns off, seen 50 ms late: its steps are those of before.
  PoseNoise noise;
  std::mt19937 random(2);
  EgoStep given, registered;
  Pose truth;
  for (int i = 0; i < 10; ++i) {
    const auto drive = [](double t) { return testing::Drive{15 - 3 * t, 0.4 * t}; };
    truth = drive(0.2 * i).step(0, 0.2);
    given = wrong_by(drive(0.2 * i - 0.05).step(0, 0.2), Twist::Zero(), Twist::Zero());
    registered = wrong_by(truth, drawn(random, kRegistration), kBelieved);
    note_step(noise, given, registered);
  }
  const Twist variance = likely_noise(noise, usual_noise(EgoSource::poses, {15, 0, 0}));
  EXPECT_GT(std::sqrt(variance[2]), 0.002);  // rad, of 0.004
  const EgoStep joined = fused(taken(given, variance), registered);
  EXPECT_LT(testing::angle_between(joined.T_to_from, truth),
            0.1 * testing::angle_between(given.T_to_from, truth));
}

TEST(EgoFusion, covariance_is_what_many_trials_show) {
  std::mt19937 random(5);
  const Twist a = sigmas(0.002, 0.03), b = kBelieved;
  constexpr int kTrials = 2000;
  Matrix6d scatter = Matrix6d::Zero(), claimed = Matrix6d::Zero();
  double chi_square = 0;
  for (int i = 0; i < kTrials; ++i) {
    const EgoStep joined =
        fused(wrong_by(kStep, drawn(random, a), a), wrong_by(kStep, drawn(random, b), b));
    const Twist error = log_se3(joined.T_to_from * kStep.inverse());
    scatter += error * error.transpose() / kTrials;
    claimed = joined.covariance;
    chi_square += error.dot(claimed.ldlt().solve(error)) / kTrials;
  }
  EXPECT_NEAR(chi_square, 6, 0.4);  // five sigmas of a mean of 2000
  for (int axis = 0; axis < 6; ++axis)
    EXPECT_NEAR(std::sqrt(scatter(axis, axis) / claimed(axis, axis)), 1, 0.08) << axis;
}

TEST(EgoFusion, the_mean_is_the_same_whichever_comes_first) {
  std::mt19937 random(6);
  const EgoStep a = wrong_by(kStep, drawn(random, sigmas(0.002, 0.03)), sigmas(0.002, 0.03));
  const EgoStep b = wrong_by(kStep, drawn(random, kBelieved), kBelieved);
  const EgoStep ab = fused(a, b), ba = fused(b, a);
  EXPECT_LT(testing::translation_between(ab.T_to_from, ba.T_to_from), 1e-4);
  EXPECT_TRUE(ab.covariance.isApprox(ba.covariance, 1e-6));
}

/// @param way_m as gone, or as guessed.
Registration registered_way(double way_m, double hold) {
  Registration registration;
  registration.way = Eigen::Vector3d(-way_m, 0, 0);
  registration.covariance = 1e-6 * Matrix6d::Identity();
  registration.hold = hold;
  return registration;
}

TEST(EgoFusion, a_registration_is_worst_along_the_way) {
  const Registration moved = registered_way(1, 0.1), stood = registered_way(0, 0.1);
  const Matrix6d moving = step_of(moved).covariance;
  EXPECT_GT(moving(3, 3), 10 * moving(4, 4));
  EXPECT_GT(moving(4, 4), moved.covariance(4, 4));
  const Matrix6d standing = step_of(stood).covariance;
  EXPECT_DOUBLE_EQ(standing(3, 3), standing(4, 4));
}

TEST(EgoFusion, where_little_that_stands_holds_the_way_a_registration_that_tells_none_is_doubted) {
  const auto sigma = [](double hold) {
    return std::sqrt(step_of(registered_way(0.16, hold)).covariance(3, 3));
  };
  EXPECT_GT(sigma(0.01), 0.08);
  EXPECT_LT(sigma(0.1), 0.03);
  EXPECT_LT(sigma(1e-6), 0.17) << "no more than the way itself";
}

TEST(EgoFusion, where_little_that_stands_holds_the_way_it_may_have_lost_what_it_tells_less) {
  const auto sigma = [](double gone_m, double hold) {
    Registration registration = registered_way(0.27, hold);
    registration.T_target_source.translation().x() = -gone_m;
    return std::sqrt(step_of(registration).covariance(3, 3));
  };
  EXPECT_GT(sigma(0.05, 0.03), 0.2);
  EXPECT_LT(sigma(0.26, 0.03), 0.05);
  EXPECT_LT(sigma(0.05, 0.1), 0.03);
}

TEST(EgoFusion, fixes_that_have_fitted_a_straight_road_leave_a_turn_to_the_scans) {
  const Pose straight(Eigen::Translation3d(-1, 0, 0));
  Twist turn = Twist::Zero();
  turn[2] = 0.003;  // in a tenth of a second: begun, and smoothed away
  const EgoStep fixes = taken(wrong_by(straight, Twist::Zero(), kBelieved), smoothing_noise(0.1));
  const EgoStep scans = wrong_by(straight, turn, kBelieved);
  const EgoStep joined = fused(fixes, scans);
  EXPECT_NEAR(log_se3(joined.T_to_from * straight.inverse())[2], turn[2], 1e-4);
  EXPECT_NEAR(joined.T_to_from.translation().x(), -1, 1e-3) << "the place is that of the fixes";
}

TEST(EgoFusion, before_any_registration_the_usual_noise_holds) {
  const Twist slow = usual_noise(EgoSource::poses, kStanding);
  EXPECT_EQ(likely_noise({}, slow), slow);
  EXPECT_GT(usual_noise(EgoSource::poses, {20, 0, 0})[3], slow[3]);
  EXPECT_GT(usual_noise(EgoSource::gnss, kStanding)[3], slow[3]);
}

}  // namespace
}  // namespace lidar_upsampling
