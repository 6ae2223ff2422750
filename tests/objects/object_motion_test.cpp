// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_motion.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lidar_upsampling
