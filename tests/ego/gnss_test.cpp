// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <random>

#include "drive.h"
#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

using testing::angle_between;
using testing::at;
using testing::Drive;
using testing::translation_between;

/// Fixes of an antenna on a vehicle that stands for a while, then drives.
class Receiver {
 public:
  Receiver(double noise_m, const Eigen::Vector3d& antenna)
      : noise_(0, noise_m), antenna_(antenna) {}

  void fix(EgoMotion& ego, double t, const Pose& T_world_vehicle) {
    Eigen::Vector3d p = T_world_vehicle * antenna_;
    p += Eigen::Vector3d(noise_(random_), noise_(random_), noise_(random_));
    GnssSample sample{at(t), 0, 0, 0, antenna_};
    world_.Reverse(p.x(), p.y(), p.z(), sample.latitude_deg, sample.longitude_deg, sample.height_m);
    ego.add_gnss(sample);
  }

 private:
  GeographicLib::LocalCartesian world_{49.01, 8.41, 115};
  std::normal_distribution<double> noise_;
  Eigen::Vector3d antenna_;
  std::mt19937 random_{7};
};

struct Errors {
  double translation = 0, angle = 0;  // root mean square
};

/// Of steps of 0.1 s in the middle of ten seconds, or at the end of what is known.
Errors step_errors(const Drive& drive, double noise_m, double period, bool causal) {
  EgoMotion ego;
  Receiver receiver(noise_m, {1.5, 0.3, 1.8});
  Errors sum;
  int count = 0;
  const auto judge = [&](double t) {
    const auto step = ego.step(at(t - 0.1), at(t));
    ASSERT_TRUE(step);
    sum.translation += std::pow(translation_between(step->T_to_from, drive.step(t - 0.1, t)), 2);
    sum.angle += std::pow(angle_between(step->T_to_from, drive.step(t - 0.1, t)), 2);
    ++count;
  };
  for (double t = 0; t < 10; t += period) {
    receiver.fix(ego, t, drive.pose(t));
    if (causal && t > 5) {
      judge(t);
    }
  }
  for (double t = 3; !causal && t < 8; t += 0.05) {
    judge(t);
  }
  return {std::sqrt(sum.translation / count), std::sqrt(sum.angle / count)};
}

TEST(Gnss, heading_follows_a_curve) {
  const Drive drive{8, 0.3};
  EgoMotion ego;
  Receiver receiver(0.01, {1.5, 0.3, 1.8});
  for (double t = 0; t < 6; t += 0.1) {
    receiver.fix(ego, t, drive.pose(t));
  }
  const auto step = ego.step(at(1), at(5));
  ASSERT_TRUE(step);
  EXPECT_LT(angle_between(step->T_to_from, drive.step(1, 5)), 0.5 * kDegree);
  EXPECT_LT(translation_between(step->T_to_from, drive.step(1, 5)), 0.15);
}

TEST(Gnss, steps_are_good_to_a_centimetre_with_good_fixes) {
  for (const double yaw_rate : {0., 0.3}) {
    const Errors errors = step_errors({8, yaw_rate}, 0.01, 0.1, false);
    EXPECT_LT(errors.translation, 0.01);
    EXPECT_LT(errors.angle, 0.3 * kDegree);
    EXPECT_LT(step_errors({8, yaw_rate}, 0.01, 0.1, true).translation, 0.03);
  }
}

TEST(Gnss, steps_stay_useful_with_fixes_that_scatter_by_a_metre) {
  const Errors errors = step_errors({12, 0.1}, 1, 0.1, false);
  EXPECT_LT(errors.translation, 0.1);
  EXPECT_LT(errors.angle, 1 * kDegree);
  EXPECT_LT(step_errors({12, 0.1}, 1, 0.1, true).translation, 0.3);
}

/// Time along the drive of a vehicle that brakes from t = 4 s on and stands at t = 6 s.
double braked(double t) { return t < 4 ? t : t < 6 ? t - 0.25 * (t - 4) * (t - 4) : 5; }

TEST(Gnss, heading_is_held_while_the_vehicle_stands) {
  const Drive drive{6, 0.25};
  EgoMotion ego;
  Receiver receiver(0.02, {1, 0, 1.5});
  for (double t = 0; t < 12; t += 0.1) {
    receiver.fix(ego, t, drive.pose(braked(t)));
  }
  const auto standing = ego.step(at(8), at(10));
  ASSERT_TRUE(standing);
  EXPECT_LT(angle_between(standing->T_to_from, Pose::Identity()), 1 * kDegree);
  EXPECT_LT(standing->T_to_from.translation().norm(), 0.05);
  const auto across = ego.step(at(3), at(10));
  ASSERT_TRUE(across);
  EXPECT_LT(angle_between(across->T_to_from, drive.step(3, 5)), 3 * kDegree);
}

TEST(Gnss, heading_survives_forgetting_the_drive) {
  const Drive drive{6, 0.25};
  EgoMotion ego, forgetful;
  Receiver receiver(0.02, {0, 0, 1.5}), same_receiver(0.02, {0, 0, 1.5});
  for (double t = 0; t < 40; t += 0.1) {
    receiver.fix(ego, t, drive.pose(braked(t)));
    same_receiver.fix(forgetful, t, drive.pose(braked(t)));
    forgetful.forget_before(at(t - 0.2));
  }
  EXPECT_FALSE(forgetful.step(at(10), at(39)));  // long gone
  // The antenna sits above the origin, so only a wrong heading could tell the two steps apart.
  const auto all = ego.step(at(38), at(39));
  const auto few = forgetful.step(at(38), at(39));
  ASSERT_TRUE(all && few);
  EXPECT_LT(translation_between(all->T_to_from, few->T_to_from), 0.01);
}

TEST(Gnss, a_vehicle_that_never_moves_stays_where_it_is) {
  EgoMotion ego;
  Receiver receiver(0.01, {1, 0, 1.5});
  for (double t = 0; t < 5; t += 0.1) {
    receiver.fix(ego, t, Pose::Identity());
  }
  const auto step = ego.step(at(2), at(2.1));
  ASSERT_TRUE(step);
  EXPECT_LT(step->T_to_from.translation().norm(), 0.01);
  EXPECT_LT(angle_between(step->T_to_from, Pose::Identity()), 1e-9);
}

TEST(Gnss, a_fix_of_another_century_costs_no_search_through_the_time_between) {
  EgoMotion ego;
  Receiver receiver(0.01, {0, 0, 1});
  for (double t = 0; t < 2; t += 0.1) receiver.fix(ego, t, Pose::Identity());
  receiver.fix(ego, 5e9, Pose::Identity());
  receiver.fix(ego, -5e9, Pose::Identity());
  const auto step = ego.step(at(0.9), at(1));
  ASSERT_TRUE(step);
  EXPECT_LT(step->T_to_from.translation().norm(), 0.2);
}

TEST(Gnss, extrapolation_is_flagged_and_bounded) {
  const Drive drive{10, 0};
  EgoMotion ego;
  Receiver receiver(0.01, {0, 0, 0});
  for (double t = 0; t <= 3; t += 0.1) {
    receiver.fix(ego, t, drive.pose(t));
  }
  const auto step = ego.step(at(2.9), at(3.1));
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->extrapolated);
  EXPECT_LT(translation_between(step->T_to_from, drive.step(2.9, 3.1)), 0.05);
  EXPECT_FALSE(ego.step(at(2.9), at(3.5)));
}

TEST(Gnss, a_fix_off_the_globe_is_refused) {
  EgoMotion ego;
  EXPECT_THROW(ego.add_gnss({at(0), 91, 8, 100, Eigen::Vector3d::Zero()}), std::invalid_argument);
  EXPECT_THROW(ego.add_gnss({at(0), 49, 8, std::nan(""), Eigen::Vector3d::Zero()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
