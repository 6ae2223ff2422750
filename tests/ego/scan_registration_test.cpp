// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/scan_registration.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "drive.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/registration/voxel_grid.h"
#include "street.h"

namespace lidar_upsampling {
namespace {

using testing::angle_between;
using testing::Box;
using testing::box_at;
using testing::houses;
using testing::lidar_at;
using testing::scan_street;
using testing::translation_between;

TEST(ScanRegistration, known_motion_is_recovered_from_a_constant_velocity_guess) {
  const Pose T_world_k = lidar_at(0, 0, 0), T_world_t = lidar_at(1.5, 0.1, 0.04);
  const Pose truth = T_world_t.inverse() * T_world_k;
  const auto k = scan_street(houses(), T_world_k, 1), t = scan_street(houses(), T_world_t, 2);
  const auto found = register_scans(k.points, t.points, lidar_at(1, 0, 0).inverse() * T_world_k);
  ASSERT_TRUE(found);
  EXPECT_LT(translation_between(found->T_target_source, truth), 0.01);
  EXPECT_LT(angle_between(found->T_target_source, truth), 0.0005);
  EXPECT_GT(found->inlier_share, 0.8);
  EXPECT_LT(found->rmse_m, 0.1);
  EXPECT_GT(found->covariance(3, 3), 0);
}

TEST(ScanRegistration, cars_that_move_do_not_pull_the_ego_motion_along) {
  const Pose T_world_k = lidar_at(0, 0, 0), T_world_t = lidar_at(0.5, 0, 0.01);
  auto before = houses(), after = houses();
  for (const double x : {-15., -7., 8., 15., 24.}) {
    before.push_back(box_at(x, 2.5, 0));
    after.push_back(box_at(x + 0.8, 2.5, 0));
    before.push_back(box_at(x + 2, -3, 0));
    after.push_back(box_at(x + 2.8, -3, 0));
  }
  const auto k = scan_street(before, T_world_k, 1), t = scan_street(after, T_world_t, 2);
  const auto found = register_scans(k.points, t.points, Pose::Identity());
  ASSERT_TRUE(found);
  EXPECT_LT(translation_between(found->T_target_source, T_world_t.inverse() * T_world_k), 0.02);
  EXPECT_EQ(found->way, found->T_target_source.translation()) << "none was expected";
}

TEST(ScanRegistration, what_leads_back_to_where_it_stood_says_how_little_holds_the_way_expected) {
  // Walls along the road that go on with us as far as beams tell, and a single car's back.
  const std::vector<Box> walls{box_at(0, 8, 0, {160, 1, 3}), box_at(0, -8, 0, {160, 1, 3}),
                               box_at(12, 2, 0)};
  const auto k = scan_street(walls, lidar_at(0, 0, 0), 1),
             t = scan_street(walls, lidar_at(0, 0, 0), 2);
  const auto found =
      register_scans(k.points, t.points, lidar_at(0.4, 0, 0).inverse() * lidar_at(0, 0, 0));
  ASSERT_TRUE(found);
  EXPECT_LT(found->T_target_source.translation().norm(), 0.05);
  EXPECT_NEAR(std::abs(found->way.normalized().x()), 1, 1e-3);
  EXPECT_LT(found->hold, 0.03);
}

TEST(ScanRegistration, an_empty_plain_gives_no_answer) {
  const auto k = scan_street({}, lidar_at(0, 0, 0), 1), t = scan_street({}, lidar_at(1, 0, 0), 2);
  EXPECT_FALSE(register_scans(k.points, t.points, Pose::Identity()));
}

TEST(ScanRegistration, a_handful_of_points_gives_no_answer) {
  const testing::Points few(20, Eigen::Vector3f(10, 0, 0));
  EXPECT_FALSE(register_scans(few, few, Pose::Identity()));
  EXPECT_FALSE(register_scans({}, {}, Pose::Identity()));
}

TEST(ScanRegistration, the_number_of_threads_does_not_matter) {
  const auto k = scan_street(houses(), lidar_at(0, 0, 0), 1);
  const auto t = scan_street(houses(), lidar_at(0.7, 0, 0.02), 2);
  const auto parallel = register_scans(k.points, t.points, Pose::Identity());
  const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = register_scans(k.points, t.points, Pose::Identity());
  ASSERT_TRUE(parallel && alone);
  EXPECT_EQ(parallel->T_target_source.matrix(), alone->T_target_source.matrix());
}

TEST(VoxelGrid, cubes_hold_the_mean_of_their_points) {
  const auto [means, of_point] =
      group_by_voxel({{0.1F, 0.1F, 0.1F}, {-0.1F, 0, 0}, {0.3F, 0.1F, 0.1F}}, 0.5);
  ASSERT_EQ(means.size(), 2U);
  EXPECT_TRUE(means[0].isApprox(Eigen::Vector3f(0.2F, 0.1F, 0.1F)));
  EXPECT_TRUE(means[1].isApprox(Eigen::Vector3f(-0.1F, 0, 0)));
  EXPECT_EQ(of_point, (std::vector<int>{0, 1, 0}));
  EXPECT_THROW(static_cast<void>(group_by_voxel({}, 0)), std::invalid_argument);
}

TEST(Surface, normals_stand_on_a_plane_and_are_none_on_a_line) {
  testing::Points plane, line;
  for (int i = 0; i < 100; ++i) {
    const int row = i / 10;
    plane.emplace_back(0.1F * static_cast<float>(i % 10), 0.1F * static_cast<float>(row), 2);
    line.emplace_back(0.1F * static_cast<float>(i), 0, 0);
  }
  const Surface level(plane), thread(line);
  for (int i = 0; i < 100; ++i) {
    EXPECT_NEAR(std::abs(level.normal(i).z()), 1, 1e-3);
    EXPECT_EQ(level.normal(i), level.normal(i));
    EXPECT_TRUE(thread.normal(i).isZero());
  }
}

}  // namespace
}  // namespace lidar_upsampling
