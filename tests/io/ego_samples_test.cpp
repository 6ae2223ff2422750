// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/ego_samples.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>

namespace lidar_upsampling {
namespace {

using mrpt::obs::CActionCollection;

CActionCollection planar(double x, double y, double yaw) {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry(mrpt::poses::CPose2D(x, y, yaw), {});
  CActionCollection actions;
  actions.insert(movement);
  return actions;
}

CActionCollection spatial(double x, double z, double pitch) {
  mrpt::obs::CActionRobotMovement3D movement;
  movement.poseChange.mean = mrpt::poses::CPose3D(x, 0, z, 0, pitch, 0);
  CActionCollection actions;
  actions.insert(movement);
  return actions;
}

void expect_at(const Pose& pose, double x, double y, double z) {
  EXPECT_LT((pose.translation() - Eigen::Vector3d(x, y, z)).norm(), 1e-9)
      << pose.translation().transpose();
}

TEST(ActionOdometry, is_nowhere_before_the_first_movement) {
  ActionOdometry odometry;
  EXPECT_FALSE(odometry.T_world_vehicle());
  odometry.add(CActionCollection());
  EXPECT_FALSE(odometry.T_world_vehicle());
}

TEST(ActionOdometry, goes_on_from_where_the_last_movement_ended) {
  ActionOdometry odometry;
  odometry.add(planar(2, 0, M_PI / 2));
  odometry.add(CActionCollection());
  odometry.add(planar(3, 1, 0));
  expect_at(odometry.T_world_vehicle().value(), 1, 3, 0);
}

TEST(ActionOdometry, keeps_height_and_pitch_of_movements_in_space) {
  ActionOdometry odometry;
  odometry.add(spatial(1, 0.5, -M_PI / 2));  // nose up
  odometry.add(spatial(2, 0, 0));
  expect_at(odometry.T_world_vehicle().value(), 1, 0, 2.5);
}

TEST(EgoSamples, a_frame_is_reached_by_the_actions_before_it) {
  EgoSamples samples;
  mrpt::obs::CSensoryFrame frame;
  auto observation = mrpt::obs::CObservationComment::Create();
  observation->timestamp = mrpt::Clock::fromDouble(1e9);
  frame.insert(observation);
  samples.add_frame(frame);
  EXPECT_TRUE(samples.odometry().empty());
  samples.add_actions(planar(2, 0, 0));
  samples.add_frame(frame);
  ASSERT_EQ(samples.odometry().size(), 1U);
  EXPECT_EQ(samples.odometry()[0].stamp, observation->timestamp);
  expect_at(samples.odometry()[0].T_world_vehicle, 2, 0, 0);
}

TEST(EgoSamples, of_each_kind_one_stream_is_taken_to_the_end_piece_by_piece) {
  EgoSamples samples;
  const auto add_pose = [&](const char* label, int second) {
    mrpt::obs::CObservationRobotPose pose;
    pose.sensorLabel = label;
    pose.timestamp = mrpt::Clock::fromDouble(second);
    samples.add_observation(pose);
  };
  EXPECT_TRUE(samples.take().poses.empty());
  add_pose("SLOW", 1);
  add_pose("FAST", 1);
  add_pose("FAST", 2);
  EXPECT_EQ(samples.take().poses.size(), 2U);
  EXPECT_TRUE(samples.take().poses.empty());
  for (const int second : {3, 4}) add_pose("SLOW", second);
  add_pose("FAST", 5);
  const EgoNews news = samples.take();
  ASSERT_EQ(news.poses.size(), 1U);
  EXPECT_EQ(news.poses[0].stamp, mrpt::Clock::fromDouble(5));
}

TEST(EgoSamples, actions_are_taken_as_odometry_piece_by_piece) {
  EgoSamples samples;
  mrpt::obs::CSensoryFrame frame;
  auto observation = mrpt::obs::CObservationComment::Create();
  observation->timestamp = mrpt::Clock::fromDouble(1e9);
  frame.insert(observation);
  for (const double x : {1, 2}) {
    samples.add_actions(planar(1, 0, 0));
    samples.add_frame(frame);
    const EgoNews news = samples.take();
    ASSERT_EQ(news.odometry.size(), 1U);
    expect_at(news.odometry[0].T_world_vehicle, x, 0, 0);
  }
}

TEST(StampDefect, is_a_stamp_that_is_missing_or_so_far_away_that_differences_cannot_be_told) {
  mrpt::obs::CObservationRobotPose pose;
  for (const std::int64_t ticks : {std::int64_t{1}, std::int64_t{132000000000000000}}) {
    pose.timestamp = Stamp(Stamp::duration(ticks));
    EXPECT_FALSE(stamp_defect_of(pose)) << ticks;
  }
  for (const Stamp stamp : {INVALID_TIMESTAMP, Stamp::max(), Stamp::min()}) {
    pose.timestamp = stamp;
    EXPECT_TRUE(stamp_defect_of(pose));
    EXPECT_TRUE(ego_defect_of(pose));
  }
}

}  // namespace
}  // namespace lidar_upsampling
