// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/time_offset.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <stdexcept>

#include "simulator/camera.h"
#include "simulator/lidar.h"

namespace lidar_upsampling {
namespace {

constexpr const char* kStreet = R"(
[scenario]
duration_s = 2
[ego]
y_m = -1.7
speed_mps = 9
[lidar]
rings = 40
fov_up_deg = 3
fov_down_deg = -20
columns = 1200
noise_m = 0.01
[static]
crossing = false
[camera.CAM0]
width = 828
height = 250
fx = 480
[vehicle.oncoming]
x_m = 30
y_m = 1.7
yaw_deg = 180
speed_mps = 9
)";

/// Scores of `count` scans, 0.15 s apart, each on the picture of the same stamp.
std::vector<OffsetScores> scores_of(const std::string& changes, int count) {
  mrpt::config::CConfigFileMemory config;
  config.setContent(kStreet + changes);
  const sim::Scenario scenario = sim::scenario_from_config(config);
  const sim::World world = sim::build_world(scenario);
  const sim::CameraRenderer renderer(scenario.cameras.front());
  std::vector<OffsetScores> scores;
  for (int i = 0; i < count; ++i) {
    const Stamp stamp = sim::stamp_of(i, 1 / 0.15, 0.1);
    const LidarScan before = sim::scan_at(world, scenario.lidar, shifted(stamp, -0.1), 3).scan;
    const LidarScan scan = sim::scan_at(world, scenario.lidar, stamp, 3).scan;
    const CameraImage image = renderer.render(world, stamp, 3).image;
    const auto T_world_lidar = [&](double t) {
      return world.T_world_vehicle(sim::time_of(stamp) + t) * scan.T_vehicle_lidar;
    };
    const auto each = score_time_offsets(
        {scan, image,
         [&](double t) -> Pose { return T_world_lidar(t).inverse() * T_world_lidar(0); }, &before});
    if (each) scores.push_back(*each);
  }
  return scores;
}

std::string offset_of_ms(double ms) {
  return "[camera.CAM0]\ntime_offset_ms = " + std::to_string(ms) + "\n";
}

void expect_offset_ms(const std::string& changes, double truth_ms) {
  const auto estimate = estimate_time_offset(scores_of(changes, 9));
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(1e3 * estimate->offset_s, truth_ms, 2);
  EXPECT_NEAR(estimate->offset_s, 1e-3 * truth_ms, 4 * estimate->sigma_s + 0.0005);
  EXPECT_GT(estimate->sigma_s, 0);
  EXPECT_EQ(estimate->num_pictures, 9);
}

TEST(TimeOffset, none_is_found_where_there_is_none) { expect_offset_ms("", 0); }

TEST(TimeOffset, a_late_stamp_is_found) { expect_offset_ms(offset_of_ms(15), 15); }

TEST(TimeOffset, an_early_stamp_is_found) { expect_offset_ms(offset_of_ms(-20), -20); }

TEST(TimeOffset, it_is_found_without_rings_known_too) {
  mrpt::config::CConfigFileMemory config;
  config.setContent(kStreet + offset_of_ms(15));
  const sim::Scenario scenario = sim::scenario_from_config(config);
  const sim::World world = sim::build_world(scenario);
  LidarScan scan = sim::scan_at(world, scenario.lidar, sim::stamp_of(1, 10, 0), 3).scan;
  scan.ring.clear();
  const CameraImage image =
      sim::CameraRenderer(scenario.cameras.front()).render(world, scan.stamp, 3).image;
  EXPECT_TRUE(score_time_offsets(
      {scan, image, [](double t) -> Pose { return Pose(Eigen::Translation3d(-9 * t, 0, 0)); },
       nullptr}));
}

TEST(TimeOffset, a_vehicle_at_rest_cannot_tell) {
  EXPECT_TRUE(scores_of("[ego]\nspeed_mps = 0\n", 1).empty());
  EXPECT_FALSE(estimate_time_offset({}));
}

TEST(TimeOffset, a_few_pictures_cannot_tell) {
  const auto one = scores_of("", 1);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_TRUE(estimate_time_offset(std::vector<OffsetScores>(8, one.front())));
  EXPECT_FALSE(estimate_time_offset(std::vector<OffsetScores>(7, one.front())));
}

TEST(TimeOffset, scores_without_a_peak_cannot_tell) {
  OffsetScores rising, flat;
  rising.speed = flat.speed = 10;
  flat.score.assign(101, 5);
  for (int i = 0; i < 101; ++i) rising.score.push_back(i);
  EXPECT_FALSE(estimate_time_offset(std::vector<OffsetScores>(20, rising)));
  EXPECT_FALSE(estimate_time_offset(std::vector<OffsetScores>(20, flat)));
}

TEST(TimeOffset, a_crawling_vehicle_is_less_certain_than_a_fast_one) {
  OffsetScores peak;
  for (int i = 0; i < 101; ++i) peak.score.push_back(100 - std::abs(i - 60));
  peak.speed = 10;
  const auto fast = estimate_time_offset(std::vector<OffsetScores>(20, peak));
  ASSERT_TRUE(fast);
  EXPECT_NEAR(fast->offset_s, 0.01, 1e-6);
  EXPECT_NEAR(fast->sigma_s, 0.002, 1e-6);  // two centimetres
  peak.speed = 1;
  EXPECT_FALSE(estimate_time_offset(std::vector<OffsetScores>(20, peak)));
}

}  // namespace
}  // namespace lidar_upsampling
