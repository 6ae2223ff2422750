// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/sensor_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lidar_upsampling/units.h"
#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

World driving_world() {
  World world = empty_world();
  world.ego.motion = {3, -5, 0.2, 0, 10, {{1, 0, 0.3}}};
  return world;
}

TEST(SensorErrors, without_any_the_log_tells_the_truth) {
  const World world = driving_world();
  const CameraSpec camera = test_camera();
  const Stamp stamp = stamp_of(7, 30, 0.01);
  EXPECT_EQ(told_mounting(camera, 3).matrix(), camera.camera.T_vehicle_camera.matrix());
  EXPECT_EQ(told_stamp(camera, stamp, 1, 3), stamp);
  EXPECT_EQ(told_ego_pose(world, {}, stamp, 3).matrix(),
            world.T_world_vehicle(time_of(stamp)).matrix());
}

TEST(SensorErrors, the_calibration_is_off_by_as_much_as_told_whichever_way_the_seed_draws) {
  CameraSpec camera = test_camera();
  camera.calibration_error_rad = 0.3 * kDegree;
  camera.calibration_error_m = 0.04;
  std::vector<Eigen::Vector3d> ways;
  for (const std::uint32_t seed : {1U, 1U, 2U}) {
    const Pose off = camera.camera.T_vehicle_camera.inverse() * told_mounting(camera, seed);
    EXPECT_NEAR(Eigen::AngleAxisd(off.linear()).angle(), 0.3 * kDegree, 1e-6);
    EXPECT_NEAR(off.translation().norm(), 0.04, 1e-9);
    ways.emplace_back(off.translation());
  }
  EXPECT_EQ(ways[0], ways[1]);
  EXPECT_GT((ways[0] - ways[2]).norm(), 1e-3);
}

TEST(SensorErrors, stamps_jitter_about_the_regular_ones_and_stay_in_the_log) {
  CameraSpec camera = test_camera();
  camera.time_jitter_s = 0.002;
  double sum = 0, sq_sum = 0;
  const auto stamps = stamps_of(30, 0, 20);
  for (const Stamp stamp : stamps) {
    const double off = seconds_between(stamp, told_stamp(camera, stamp, 20, 5));
    EXPECT_LE(std::abs(off), 0.006 + 1e-6);
    sum += off;
    sq_sum += off * off;
  }
  const auto n = static_cast<double>(stamps.size());
  EXPECT_NEAR(sum / n, 0, 0.0003);
  EXPECT_NEAR(std::sqrt(sq_sum / n), 0.002, 0.0003);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    EXPECT_GE(told_stamp(camera, stamps.front(), 20, seed), stamps.front());
    EXPECT_LE(told_stamp(camera, stamps.back(), 20, seed), stamps.back());
  }
}

TEST(SensorErrors, poses_lag_by_as_much_as_told) {
  const World world = driving_world();
  EgoPoseSpec spec;
  spec.lag_s = 0.01;
  for (const int i : {0, 40, 150}) {
    const Stamp stamp = stamp_of(i, 100, 0);
    EXPECT_EQ(told_ego_pose(world, spec, stamp, 1).matrix(),
              world.T_world_vehicle(time_of(stamp) - 0.01).matrix());
  }
}

TEST(SensorErrors, poses_scatter_as_much_as_told_and_mostly_slowly) {
  const World world = driving_world();
  EgoPoseSpec spec;
  spec.noise_m = 0.02;
  spec.noise_rad = 0.05 * kDegree;
  double sq_m = 0, sq_rad = 0, sq_step = 0;
  int n = 0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    for (const Stamp stamp : stamps_of(100, 0, 10)) {
      const Pose T_true = world.T_world_vehicle(time_of(stamp));
      const Pose told = told_ego_pose(world, spec, stamp, seed);
      const Eigen::Vector3d off = told.translation() - T_true.translation();
      sq_m += off.squaredNorm();
      sq_rad += std::pow(Eigen::AngleAxisd(T_true.linear().transpose() * told.linear()).angle(), 2);
      if (stamp > start_stamp()) sq_step += (off - before).squaredNorm();
      before = off;
      ++n;
    }
  }
  EXPECT_NEAR(std::sqrt(sq_m / (3 * n)), 0.02, 0.002);
  EXPECT_NEAR(std::sqrt(sq_rad / (3 * n)), 0.05 * kDegree, 0.005 * kDegree);
  // From pose to pose only the white tenth of the variance is new, in both of them.
  EXPECT_NEAR(std::sqrt(sq_step / (3 * n)), 0.02 * std::sqrt(0.2), 0.002);
}

TEST(SensorErrors, a_picture_shows_the_instant_of_its_exposure_and_not_of_its_stamp) {
  World world = driving_world();
  CameraSpec camera = test_camera();
  camera.time_offset_s = 0.1;
  EXPECT_NEAR(CameraRenderer(camera).render(world, stamp_of(1, 1, 0), 1).taken_at, 0.9, 1e-9);
}

TEST(Cyclist, is_of_a_riders_size_and_stands_on_two_thin_wheels) {
  const Object cyclist = make_vehicle("cyclist", 5);
  EXPECT_EQ(cyclist.class_name, "cyclist");
  Eigen::AlignedBox3d extent;
  for (const Part& part : cyclist.parts) {
    for (const Eigen::Vector3d& v : part.solid.vertices) extent.extend(v);
    if (!part.solid.vertices.empty()) continue;
    extent.extend(part.solid.center - part.solid.radii);
    extent.extend(part.solid.center + part.solid.radii);
  }
  EXPECT_NEAR(extent.sizes().x(), cyclist.shape.length, 0.02);
  EXPECT_NEAR(extent.sizes().y(), cyclist.shape.width, 0.02);
  EXPECT_NEAR(extent.sizes().z(), cyclist.shape.height, 0.02);
  EXPECT_NEAR(extent.min().z(), 0, 1e-9);
  const auto inside = [&](const Eigen::Vector3d& p) {
    for (const Part& part : cyclist.parts) {
      if (signed_distance(part.solid, p) < 0) return true;
    }
    return false;
  };
  EXPECT_TRUE(inside({0.7, 0, 0.3}));
  EXPECT_FALSE(inside({0.7, 0.05, 0.3}));
  // Daylight between the wheels.
  EXPECT_FALSE(inside({0.15, 0, 0.1}));
}

}  // namespace
}  // namespace lidar_upsampling::sim
