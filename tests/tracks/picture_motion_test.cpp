// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/picture_motion.h"

#include <gtest/gtest.h>

#include "lidar_upsampling/vision/projection.h"
#include "tracks/car_on_pictures.h"

namespace lidar_upsampling {
namespace {

using testing::ahead;
using testing::car;
using testing::kCentroid;
using testing::kStart;

CameraModel camera() { return {1200, 600, 700, 700, 600, 300}; }

std::vector<Correspondence> seen_after(const Twist& motion) {
  std::vector<Correspondence> pairs;
  for (const Eigen::Vector3d& point : car())
    if (const auto pixel = project(camera(), ahead() * motion_pose(motion, kCentroid) * point))
      pairs.push_back({point, {pixel->x(), pixel->y()}});
  return pairs;
}

Twist driven(double x, double yaw) {
  Twist motion = Twist::Zero();
  motion[2] = yaw;
  motion[3] = x;
  return motion;
}

MotionQuestion question_in(double dt) {
  MotionQuestion question;
  question.instant = shifted(kStart, dt);
  question.centroid = kCentroid;
  return question;
}

ObjectTrack track() {
  ObjectTrack result;
  result.stamp = kStart;
  result.state = result.latest = new_track_state(kStart, {});
  return result;
}

TEST(PictureMotion, is_what_the_points_alone_tell) {
  const Twist motion = driven(0.4, 0.03);
  const auto fit = picture_motion(seen_after(motion), camera(), ahead(), kCentroid, {});
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->mean.isApprox(motion, 1e-3)) << fit->mean.transpose();
  const MotionAnswer answer = answer_of_picture(track(), fit, question_in(0.1), {});
  EXPECT_TRUE(answer.moves);
  EXPECT_NEAR(answer.state.velocity().x(), 4, 0.01);
}

TEST(PictureMotion, is_told_of_a_parked_object_as_well) {
  const auto fit = picture_motion(seen_after(Twist::Zero()), camera(), ahead(), kCentroid, {});
  ASSERT_TRUE(fit);
  EXPECT_TRUE(answer_of_picture(track(), fit, question_in(0.1), {}).moves);
}

TEST(PictureMotion, is_none_where_few_points_are_found_or_they_tell_what_no_vehicle_does) {
  auto pairs = seen_after(driven(8, 0));
  const auto fit = picture_motion(pairs, camera(), ahead(), kCentroid, {});
  EXPECT_FALSE(answer_of_picture(track(), fit, question_in(0.1), {}).moves);
  pairs.resize(7);
  EXPECT_FALSE(picture_motion(pairs, camera(), ahead(), kCentroid, {}));
}

}  // namespace
}  // namespace lidar_upsampling
