// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "lidar_upsampling/units.h"
#include "shipped.h"
#include "simulator/sensor_errors.h"

// What the scenarios beyond town streets and beyond one regular rig promise: as written (0), and as
// seeds draw it.
namespace lidar_upsampling::sim {
namespace {

class RigPromise : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RigPromise, every_scenario_is_short_says_what_it_tests_and_shows_what_moves) {
  for (const std::string name :
       {"motorway", "crossing_crowd", "slow_scanner", "ring", "real_rig", "free_running"}) {
    const Shipped shipped(name, GetParam(), 3);
    EXPECT_GE(shipped.scenario.duration_s, 2) << name;
    EXPECT_LE(shipped.scenario.duration_s, 3) << name;
    const auto moves = [&](int v, double t) { return shipped.vehicle_at(v, t).speed > 0.3; };
    EXPECT_GE(shipped.num_vehicles_that(3, moves), 3) << name;
    std::ifstream file(SCENARIO_FOLDER "/" + name + ".ini");
    std::string first_line;
    std::getline(file, first_line);
    EXPECT_EQ(first_line.substr(0, 2), "# ") << name;
  }
}

TEST_P(RigPromise, motorway_traffic_is_fast_over_ground_and_slow_or_fast_against_us) {
  const Shipped motorway("motorway", GetParam());
  int slow = 0, fast = 0;
  for (int v = 0; v < motorway.num_vehicles(); ++v) {
    const double speed = motorway.vehicle_at(v, 0).speed, ego = motorway.ego_at(0).speed;
    EXPECT_GE(speed, 24);
    EXPECT_LE(speed, 41);
    const auto ahead = [&](int, double) { return std::cos(motorway.vehicle_at(v, 0).yaw) > 0; };
    if (motorway.num_scans(v, ahead) < 10) continue;
    ++(std::abs(speed - ego) < 2 ? slow : fast);
  }
  EXPECT_GE(slow, 2);
  EXPECT_GE(fast, 3);
  const auto closes_in = [&](int v, double t) {
    return (motorway.ego_at(t).velocity() - motorway.vehicle_at(v, t).velocity()).x() > 60;
  };
  EXPECT_GE(motorway.num_vehicles_that(3, closes_in), 2);
}

TEST_P(RigPromise, crossing_crowd_walks_and_rides_close_before_a_turning_ego) {
  const Shipped crowd("crossing_crowd", GetParam());
  const auto close = [&](int v, double t) {
    return crowd.distance(v, t) > 3 && crowd.distance(v, t) < 15;
  };
  int walkers = 0, riders = 0;
  for (int v = 0; v < crowd.num_vehicles(); ++v) {
    if (crowd.num_scans(v, close) < 5) continue;
    walkers += crowd.is(v, "pedestrian") ? 1 : 0;
    riders += crowd.is(v, "cyclist") ? 1 : 0;
  }
  EXPECT_GE(walkers, 4);
  EXPECT_GE(riders, 2);
  const double turned = crowd.ego_at(0).yaw - crowd.ego_at(crowd.scenario.duration_s).yaw;
  EXPECT_GT(turned, 60 * kDegree);
}

TEST_P(RigPromise, slow_scanner_leaves_200_ms_between_scans_and_pictures_change_their_exposure) {
  const Scenario slow = Shipped::loaded("slow_scanner", GetParam());
  EXPECT_EQ(slow.lidar.rate_hz, 5);
  EXPECT_EQ(slow.cameras[0].rate_hz, 20);
  EXPECT_EQ(slow.ego_poses.kind, EgoPoseKind::gnss);
  std::set<double> gains;
  for (const Stamp stamp : stamps_of(20, 0, slow.duration_s)) {
    gains.insert(gain_at(slow.cameras[0], time_of(stamp)));
  }
  EXPECT_LT(*gains.begin(), 0.7);
  EXPECT_GT(*gains.rbegin(), 1.5);
}

TEST_P(RigPromise, ring_sees_all_round) {
  const Scenario ring = Shipped::loaded("ring", GetParam());
  ASSERT_EQ(ring.cameras.size(), 6U);
  for (int degree = 0; degree < 360; ++degree) {
    const Eigen::Vector3d to(std::cos(degree * kDegree), std::sin(degree * kDegree), 0);
    EXPECT_TRUE(std::any_of(ring.cameras.begin(), ring.cameras.end(), [&](const CameraSpec& spec) {
      const CameraModel& m = spec.camera.model;
      const Eigen::Vector3d p = spec.camera.T_vehicle_camera.linear().transpose() * to;
      return p.z() > 0 && std::abs(p.x() / p.z()) < 0.5 * m.width / m.fx;
    })) << degree;
  }
}

TEST_P(RigPromise, ring_vehicles_pass_from_camera_to_camera_overtaking_and_overtaken) {
  const Shipped ring("ring", GetParam());
  int passing = 0;
  for (int v = 0; v < ring.num_vehicles(); ++v) {
    std::set<std::size_t> seen_by;
    for (std::size_t c = 0; c < 6; ++c) {
      int scans = 0;
      for (std::size_t i = 0; i < ring.stamps.size(); ++i) scans += ring.in_view(v, i, 20, c);
      if (scans >= 2) seen_by.insert(c);
    }
    passing += seen_by.size() >= 3 ? 1 : 0;
  }
  EXPECT_GE(passing, 3);
  const auto ends_ahead = [&](int v, double t) {
    return ring.vehicle_at(v, t).x > ring.ego_at(t).x;
  };
  const double end = ring.scenario.duration_s;
  int overtake_us = 0, overtaken = 0;
  for (int v = 0; v < ring.num_vehicles(); ++v) {
    if (std::cos(ring.vehicle_at(v, 0).yaw) < 0) continue;
    overtake_us += !ends_ahead(v, 0) && ends_ahead(v, end) ? 1 : 0;
    overtaken += ends_ahead(v, 0) && !ends_ahead(v, end) ? 1 : 0;
  }
  EXPECT_GE(overtake_us, 1);
  EXPECT_GE(overtaken, 1);
}

TEST_P(RigPromise, real_rig_tells_calibration_clock_and_poses_as_wrong_as_it_says) {
  const Shipped rig("real_rig", GetParam());
  const CameraSpec& camera = rig.scenario.cameras[0];
  EXPECT_TRUE(rig.scenario.lidar.sweep);
  EXPECT_EQ(rig.scenario.carrier, "velodyne");
  const Pose off =
      camera.camera.T_vehicle_camera.inverse() * told_mounting(camera, rig.scenario.seed);
  EXPECT_NEAR(Eigen::AngleAxisd(off.linear()).angle(), 0.2 * kDegree, 1e-6);
  EXPECT_NEAR(off.translation().norm(), 0.02, 1e-9);
  EXPECT_NEAR(camera.time_offset_s, 0.005, 1e-12);
  EXPECT_NEAR(camera.time_jitter_s, 0.002, 1e-12);
  EXPECT_NEAR(rig.scenario.ego_poses.lag_s, 0.01, 1e-12);
  EXPECT_NEAR(rig.scenario.ego_poses.noise_m, 0.02, 1e-12);
  EXPECT_NEAR(rig.scenario.ego_poses.noise_rad, 0.05 * kDegree, 1e-12);
  const auto in_town = [&](int v, double t) {
    const double speed = rig.vehicle_at(v, t).speed;
    return speed > 6.5 && speed < 16.5;
  };
  EXPECT_GE(rig.num_vehicles_that(5, in_town), 3);
}

TEST_P(RigPromise, free_running_pictures_lie_at_any_time_between_scans) {
  const Shipped free("free_running", GetParam());
  std::set<long> phases_ms;
  for (const Stamp stamp : stamps_of(free.scenario.cameras[0].rate_hz,
                                     free.scenario.cameras[0].phase_s, free.scenario.duration_s)) {
    const long phase_ms = std::lround(1000 * time_of(stamp)) % 100;
    phases_ms.insert(phase_ms);
    EXPECT_NE(phase_ms, 0);
  }
  EXPECT_GE(phases_ms.size(), 3U);
  const EgoPoseSpec& poses = free.scenario.ego_poses;
  EXPECT_EQ(poses.noise_m + poses.noise_rad + poses.lag_s, 0);
  EXPECT_GE(free.ego_at(0).speed, 9);
  EXPECT_LE(free.ego_at(0).speed, 13);
}

INSTANTIATE_TEST_SUITE_P(as_written_and_drawn, RigPromise, testing::Values(0U, 1U, 2U, 3U));

}  // namespace
}  // namespace lidar_upsampling::sim
