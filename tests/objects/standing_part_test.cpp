// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/standing_part.h"

#include <gtest/gtest.h>

#include <numeric>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kDt = 0.1;

// Camera and LiDAR at one place, looking along x; the ego stands.
MotionQuery street_query() {
  MotionQuery query;
  query.camera.width = 1200;
  query.camera.height = 400;
  query.camera.fx = query.camera.fy = 700;
  query.camera.cx = 600;
  query.camera.cy = 200;
  query.T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  query.dt = kDt;
  query.prior = expect_motion({}, {}, Eigen::Matrix3d::Identity(), {10, 0, 0}, kDt, {});
  return query;
}

// Points of something upright, 0.4 m wide, that has moved until the image.
void add_body(std::vector<Correspondence>& pairs, const MotionQuery& query,
              const Eigen::Vector2d& at, const Pose& T_mov, double height = 1.5) {
  for (double y = -0.2; y < 0.25; y += 0.1)
    for (double z = 0; z <= height; z += 0.25) {
      const Eigen::Vector3d point(at.x(), at.y() + y, z - 1);
      const auto pixel = project(query.camera, query.T_camera_lidar * T_mov * point);
      pairs.push_back({point, *pixel});
    }
}

const Pose kStays = Pose::Identity();
const Pose kWalks = Pose(Eigen::Translation3d(0, -0.15, 0));

int count_of(const std::vector<std::uint8_t>& stands) {
  return std::accumulate(stands.begin(), stands.end(), 0);
}

TEST(StandingPart, a_post_beside_someone_who_walks_is_told) {
  const MotionQuery query = street_query();
  std::vector<Correspondence> pairs;
  add_body(pairs, query, {10, 0.9}, kStays);
  const auto num_standing = pairs.size();
  add_body(pairs, query, {10, 0}, kWalks);
  const auto stands = standing_part(pairs, query, {});
  ASSERT_EQ(stands.size(), pairs.size());
  EXPECT_EQ(count_of(stands), static_cast<int>(num_standing));
  EXPECT_EQ(stands.front(), 1);
  EXPECT_EQ(stands.back(), 0);
}

TEST(StandingPart, two_that_walk_alike_are_one_body) {
  const MotionQuery query = street_query();
  std::vector<Correspondence> pairs;
  add_body(pairs, query, {10, 0.9}, kWalks);
  add_body(pairs, query, {10, 0}, kWalks);
  EXPECT_TRUE(standing_part(pairs, query, {}).empty());
}

TEST(StandingPart, what_touches_is_one_body) {
  const MotionQuery query = street_query();
  std::vector<Correspondence> pairs;
  add_body(pairs, query, {10, 0.5}, kStays);
  add_body(pairs, query, {10, 0}, kWalks);
  EXPECT_TRUE(standing_part(pairs, query, {}).empty());
}

TEST(StandingPart, of_what_comes_straight_near_the_part_ahead_seems_to_stand_but_does_not) {
  const MotionQuery query = street_query();
  const Pose T_comes_near(Eigen::Translation3d(-0.6, 0, 0));
  std::vector<Correspondence> pairs;
  for (double y = -0.1; y < 0.15; y += 0.1)
    for (double z = -0.2; z < 0.25; z += 0.1) {
      const Eigen::Vector3d point(10, y, z);
      pairs.push_back({point, *project(query.camera, query.T_camera_lidar * T_comes_near * point)});
    }
  add_body(pairs, query, {10, 1.2}, T_comes_near);
  EXPECT_TRUE(standing_part(pairs, query, {}).empty());
}

TEST(StandingPart, one_ring_that_slides_may_be_an_edge) {
  const MotionQuery query = street_query();
  std::vector<Correspondence> pairs;
  add_body(pairs, query, {10, 0.9}, kStays);
  for (double y = -0.4; y < 0.45; y += 0.1) {
    const Eigen::Vector3d point(10, y, 0);
    pairs.push_back({point, *project(query.camera, query.T_camera_lidar * kWalks * point)});
  }
  EXPECT_TRUE(standing_part(pairs, query, {}).empty());
}

}  // namespace
}  // namespace lidar_upsampling
