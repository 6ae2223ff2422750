// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_motion.h"

#include <gtest/gtest.h>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

// An object that no followed point shows any more, and that was taken to drive 0.5 m ahead.
ObjectMotion unseen(double known_evidence, bool known_moving,
                    const ObjectMotionOptions& options = {}) {
  MotionQuery query;
  query.dt = 0.1;
  query.centroid_lidar_k = {10, 0, 0};
  query.prior.T_mov = Pose(Eigen::Translation3d(0.5, 0, 0));
  query.known_evidence = known_evidence;
  query.known_moving = known_moving;
  return estimate_object_motion({}, query, options);
}

TEST(UnseenObject, moves_on_if_a_picture_has_told_it_from_a_parked_one) {
  const ObjectMotion motion = unseen(5, true);
  EXPECT_EQ(motion.status, MotionStatus::predicted);
  EXPECT_NEAR(motion.velocity_lidar_k.x(), 5, 1e-9);
}

TEST(UnseenObject, moves_on_if_scans_have_told_it_from_a_parked_one) {
  EXPECT_EQ(unseen(50, false).status, MotionStatus::predicted);
}

TEST(UnseenObject, stays_if_it_may_as_well_be_parked) {
  const ObjectMotion motion = unseen(5, false);
  EXPECT_EQ(motion.status, MotionStatus::too_few_points);
  EXPECT_EQ(motion.velocity_lidar_k.norm(), 0);
}

TEST(UnseenObject, stays_where_nothing_from_before_may_count) {
  ObjectMotionOptions options;
  options.prior.from_scans = options.prior.from_images = options.prior.ground = false;
  EXPECT_EQ(unseen(50, true, options).status, MotionStatus::too_few_points);
}

// Someone 10 m ahead, whose points all seem to have gone to the left by so much.
ObjectMotion seen_to_step(double step_m) {
  MotionQuery query;
  query.dt = 0.1;
  query.centroid_lidar_k = {10, 0, 0};
  query.camera = {1200, 400, 700, 700, 600, 200, DistortionModel::none, {}};
  query.T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  std::vector<Correspondence> pairs;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d point(10 + 0.01 * (i % 7), 0.1 * (i % 8) - 0.35, 0.2 * (i / 8.) - 0.4);
    const Eigen::Vector3d seen = point + Eigen::Vector3d(0, step_m, 0);
    pairs.push_back({point, *project(query.camera, query.T_camera_lidar * seen)});
  }
  ObjectMotionOptions options;
  options.prior.from_scans = options.prior.from_images = options.prior.ground = false;
  return estimate_object_motion(pairs, query, options);
}

TEST(StandingObject, is_as_unsure_as_the_picture_would_rather_have_it_move) {
  // A third of a pixel is what calibration may be wrong by.
  const ObjectMotion standing = seen_to_step(0), doubtful = seen_to_step(0.0045);
  ASSERT_EQ(standing.status, MotionStatus::stationary);
  ASSERT_EQ(doubtful.status, MotionStatus::stationary);
  EXPECT_LT(standing.unproven_step.norm(), 1e-3);
  EXPECT_NEAR(doubtful.unproven_step.y(), 0.0045, 0.001);
  EXPECT_GE(position_uncertainty(doubtful)(1, 1), 0.0035 * 0.0035);
  EXPECT_EQ(seen_to_step(0.5).status, MotionStatus::moving);
  EXPECT_EQ(seen_to_step(0.5).unproven_step.norm(), 0);
}

}  // namespace
}  // namespace lidar_upsampling
