// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/ego_motion.h"

#include <gtest/gtest.h>

#include <limits>

#include "drive.h"

namespace lidar_upsampling {
namespace {

using testing::angle_between;
using testing::at;
using testing::Drive;
using testing::translation_between;

EgoMotion driven(const Drive& drive, double period, double until, EgoMotionOptions options = {}) {
  EgoMotion ego(options);
  for (int i = 0; i * period <= until + 1e-9; ++i) {
    ego.add_pose({at(i * period), drive.pose(i * period)});
  }
  return ego;
}

TEST(EgoMotion, straight_drive_is_interpolated_exactly) {
  const Drive drive{12, 0};
  const auto step = driven(drive, 0.1, 2).step(at(0.533), at(1.277));
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->extrapolated);
  EXPECT_LT(translation_between(step->T_to_from, drive.step(0.533, 1.277)), 1e-6);
}

TEST(EgoMotion, step_takes_a_point_ahead_closer_when_driving_forward) {
  const auto step = driven({10, 0}, 0.1, 1).step(at(0.2), at(0.3));
  ASSERT_TRUE(step);
  EXPECT_NEAR((step->T_to_from * Eigen::Vector3d(20, 0, 0)).x(), 19, 1e-6);
}

TEST(EgoMotion, turn_is_interpolated_to_the_sagitta_of_a_sample_step) {
  const Drive drive{10, 0.5};
  const auto step = driven(drive, 0.1, 2).step(at(0.55), at(0.95));
  ASSERT_TRUE(step);
  // Chord against arc: v * w * dt^2 / 8 = 6 mm, at each end.
  EXPECT_LT(translation_between(step->T_to_from, drive.step(0.55, 0.95)), 0.0126);
  EXPECT_LT(angle_between(step->T_to_from, drive.step(0.55, 0.95)), 1e-6);
}

TEST(EgoMotion, nothing_is_interpolated_across_a_gap) {
  EgoMotion ego;
  const Drive drive;
  for (const double t : {0.0, 0.5, 3.0, 3.5}) {
    ego.add_pose({at(t), drive.pose(t)});
  }
  EXPECT_FALSE(ego.step(at(0.4), at(1.5)));
  EXPECT_FALSE(ego.step(at(0.55), at(0.4)));
  EXPECT_TRUE(ego.step(at(0.4), at(3.2)));  // both ends are known
}

TEST(EgoMotion, extrapolation_follows_the_turn_and_is_flagged) {
  const Drive drive{10, 0.4};
  const EgoMotion ego = driven(drive, 0.05, 1);
  const auto step = ego.step(at(1), at(1.2));
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->extrapolated);
  EXPECT_LT(translation_between(step->T_to_from, drive.step(1, 1.2)), 1e-3);
  EXPECT_LT(angle_between(step->T_to_from, drive.step(1, 1.2)), 1e-5);
  const auto before = ego.step(at(-0.2), at(0));
  ASSERT_TRUE(before);
  EXPECT_TRUE(before->extrapolated);
  EXPECT_LT(translation_between(before->T_to_from, drive.step(-0.2, 0)), 1e-3);
}

TEST(EgoMotion, extrapolation_ends_at_its_limit) {
  EgoMotionOptions options;
  options.max_extrapolation_s = 0.1;
  EXPECT_TRUE(driven({}, 0.1, 1, options).step(at(0.5), at(1.09)));
  EXPECT_FALSE(driven({}, 0.1, 1, options).step(at(0.5), at(1.11)));
  options.max_extrapolation_s = 0;
  EXPECT_FALSE(driven({}, 0.1, 1, options).step(at(0.5), at(1.0001)));
}

TEST(EgoMotion, late_samples_are_sorted_in) {
  const Drive drive{10, 0.3};
  EgoMotion ego;
  for (const double t : {0.4, 0.0, 0.3, 0.1, 0.2}) {
    ego.add_pose({at(t), drive.pose(t)});
  }
  const auto step = ego.step(at(0.1), at(0.3));
  ASSERT_TRUE(step);
  EXPECT_LT(translation_between(step->T_to_from, drive.step(0.1, 0.3)), 1e-9);
}

TEST(EgoMotion, of_two_samples_with_one_stamp_the_later_counts) {
  const Drive drive{10, 0};
  EgoMotion ego = driven(drive, 0.1, 0.5);
  Pose corrected = drive.pose(0.3);
  corrected.translation().y() = 1;
  ego.add_pose({at(0.3), corrected});
  const auto step = ego.step(at(0.3), at(0.2));
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->T_to_from.translation().y(), 1, 1e-9);
}

TEST(EgoMotion, a_pose_that_is_not_finite_is_refused) {
  EgoMotion ego;
  PoseSample sample{at(0), Pose::Identity()};
  sample.T_world_vehicle.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ego.add_pose(sample), std::invalid_argument);
}

TEST(EgoMotion, automatic_source_prefers_poses_then_odometry_then_gnss_then_camera) {
  EgoMotion ego;
  EXPECT_EQ(ego.source(), EgoSource::camera);
  EXPECT_FALSE(ego.step(at(0), at(0.1)));
  ego.add_gnss({at(0), 49, 8.4, 100, Eigen::Vector3d::Zero()});
  EXPECT_EQ(ego.source(), EgoSource::camera);
  ego.add_gnss({at(0.1), 49, 8.4, 100, Eigen::Vector3d::Zero()});
  EXPECT_EQ(ego.source(), EgoSource::gnss);
  ego.add_odometry({at(0), Pose::Identity()});
  ego.add_odometry({at(0.1), Pose::Identity()});
  EXPECT_EQ(ego.source(), EgoSource::odometry);
  ego.add_pose({at(0), Pose::Identity()});
  ego.add_pose({at(0.1), Pose::Identity()});
  EXPECT_EQ(ego.source(), EgoSource::poses);
}

TEST(EgoMotion, odometry_is_used_as_it_drifts) {
  const Drive drive{10, 0.2};
  EgoMotionOptions options;
  options.source = EgoSource::odometry;
  EgoMotion ego(options);
  Pose T_odom_world = Pose::Identity();
  T_odom_world.translation() = Eigen::Vector3d(100, -50, 3);
  for (double t = 0; t < 1; t += 0.02) {
    ego.add_odometry({at(t), T_odom_world * drive.pose(t)});
  }
  const auto step = ego.step(at(0.31), at(0.77));
  ASSERT_TRUE(step);
  EXPECT_LT(translation_between(step->T_to_from, drive.step(0.31, 0.77)), 1e-3);
}

TEST(EgoMotion, source_none_holds_the_vehicle_still) {
  EgoMotionOptions options;
  options.source = EgoSource::none;
  const auto step = driven({10, 0}, 0.1, 1, options).step(at(0), at(0.5));
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->T_to_from.isApprox(Pose::Identity()));
}

TEST(EgoMotion, forgetting_keeps_what_later_steps_need) {
  const Drive drive{10, 0.3};
  EgoMotion ego = driven(drive, 0.05, 60);
  const auto before = ego.step(at(50.02), at(50.33));
  ego.forget_before(at(50.02));
  const auto after = ego.step(at(50.02), at(50.33));
  ASSERT_TRUE(before && after);
  EXPECT_LT(translation_between(before->T_to_from, after->T_to_from), 1e-12);
  EXPECT_FALSE(ego.step(at(10), at(10.1)));
  ego.forget_before(at(1000));
  EXPECT_TRUE(ego.step(at(60), at(60.2)));  // the last velocity is still known
}

TEST(EgoMotion, names_of_sources_are_those_of_the_settings) {
  EXPECT_STREQ(to_string(EgoSource::automatic), "auto");
  EXPECT_STREQ(to_string(EgoSource::poses), "poses");
  EXPECT_STREQ(to_string(EgoSource::odometry), "odometry");
  EXPECT_STREQ(to_string(EgoSource::gnss), "gnss");
  EXPECT_STREQ(to_string(EgoSource::camera), "camera");
  EXPECT_STREQ(to_string(EgoSource::none), "none");
}

}  // namespace
}  // namespace lidar_upsampling
