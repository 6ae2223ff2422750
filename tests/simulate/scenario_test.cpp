// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/scenario.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <filesystem>
#include <stdexcept>

#include "simulator/variation.h"
#include "simulator/world.h"

namespace lidar_upsampling::sim {
namespace {

Scenario parsed(const std::string& ini) {
  return scenario_from_config(mrpt::config::CConfigFileMemory(ini));
}

std::string refusal(const std::string& ini) {
  try {
    (void)parsed(ini);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::vector<std::filesystem::path> shipped() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SCENARIO_FOLDER)) {
    files.push_back(entry.path());
  }
  return files;
}

TEST(Scenario, an_unknown_key_is_refused_by_its_name) {
  const std::string message = refusal("[lidar]\nrings = 32\ncolums = 900\n");
  EXPECT_NE(message.find("colums"), std::string::npos);
  EXPECT_NE(message.find("[lidar]"), std::string::npos);
  EXPECT_NE(message.find("columns"), std::string::npos);
  EXPECT_NE(refusal("[camera.LEFT]\nf_x = 700\n").find("[camera.LEFT] f_x"), std::string::npos);
  EXPECT_NE(refusal("[radar]\nlabel = R\n").find("[radar]"), std::string::npos);
}

TEST(Scenario, a_value_that_cannot_be_is_refused_with_the_ones_that_can) {
  EXPECT_NE(refusal("[lidar]\nrate_hz = often\n").find("rate_hz"), std::string::npos);
  EXPECT_NE(refusal("[lidar]\nnoise_m = -1\n").find("-1"), std::string::npos);
  EXPECT_NE(refusal("[lidar]\nposition_m = 1 2\n").find("3 numbers"), std::string::npos);
  EXPECT_NE(refusal("[vehicle.a]\ntype = tank\n").find("pedestrian"), std::string::npos);
  EXPECT_NE(refusal("[vehicle.a]\nmotion = fly\n").find("fly"), std::string::npos);
  EXPECT_NE(refusal("[log]\nformat = bag\n").find("sensory_frames"), std::string::npos);
  EXPECT_NE(refusal("[appearance]\nsun = -1\n").find("[appearance] sun is -1"), std::string::npos);
  EXPECT_NE(refusal("[lidar]\nmin_range_m = 9\nmax_range_m = 8\n").find("max_range_m"),
            std::string::npos);
}

TEST(Scenario, a_depth_camera_has_a_picture_in_place_of_rings) {
  const Scenario scenario = parsed(
      "[lidar]\ntype = depth_camera\nwidth = 64\nheight = 48\nfx = 60\n"
      "noise_per_m2 = 0.001\nmax_range_m = 6\n[appearance]\nsky = 0.2\ngrain = 0\n");
  const LidarSpec& depth = scenario.lidar;
  ASSERT_TRUE(depth.depth_camera);
  EXPECT_EQ(depth.num_rings(), 48);
  EXPECT_EQ(depth.columns, 64);
  EXPECT_EQ(depth.depth_camera->fy, 60);
  EXPECT_EQ(depth.depth_camera->cx, 31.5);
  EXPECT_EQ(depth.noise_per_m2, 0.001);
  EXPECT_EQ(scenario.appearance.sky, 0.2);
  EXPECT_EQ(build_world(scenario).objects.front().grain, 0);

  const std::string type = "[lidar]\ntype = depth_camera\n";
  EXPECT_NE(refusal("[lidar]\ntype = sonar\n").find("spinning, depth_camera"), std::string::npos);
  EXPECT_NE(refusal(type + "rings = 16\n").find("[lidar] rings"), std::string::npos);
  EXPECT_NE(refusal(type + "max_range_m = 80\n").find("0 to 65"), std::string::npos);
  EXPECT_NE(refusal(type + "noise_per_m2 = 1\n").find("noise_per_m2 is 1"), std::string::npos);
  EXPECT_NE(refusal(type + "[log]\ncarrier = pointcloud\n").find("[log] carrier"),
            std::string::npos);
  EXPECT_NE(refusal("[lidar]\nwidth = 64\n").find("[lidar] width"), std::string::npos);
}

TEST(Scenario, errors_of_the_rig_are_read_in_their_units_and_are_none_unless_given) {
  const Scenario scenario = parsed(
      "[camera.A]\ntime_jitter_ms = 2\ncalibration_error_deg = 90\ncalibration_error_m = 0.02\n"
      "[camera.B]\n[ego_poses]\nnoise_m = 0.03\nnoise_deg = 90\nlag_ms = 10\n");
  EXPECT_NEAR(scenario.cameras[0].time_jitter_s, 0.002, 1e-12);
  EXPECT_NEAR(scenario.cameras[0].calibration_error_rad, M_PI / 2, 1e-12);
  EXPECT_EQ(scenario.cameras[0].calibration_error_m, 0.02);
  const CameraSpec& exact = scenario.cameras[1];
  EXPECT_EQ(exact.time_jitter_s + exact.calibration_error_rad + exact.calibration_error_m, 0);
  EXPECT_EQ(scenario.ego_poses.noise_m, 0.03);
  EXPECT_NEAR(scenario.ego_poses.noise_rad, M_PI / 2, 1e-12);
  EXPECT_NEAR(scenario.ego_poses.lag_s, 0.01, 1e-12);
  EXPECT_NE(refusal("[ego_poses]\nkind = odometry\nnoise_m = 1\n").find("[ego_poses] noise_m"),
            std::string::npos);
  EXPECT_NE(refusal("[ego_poses]\nkind = gnss\nnoise_deg = 1\n").find("[ego_poses] noise_deg"),
            std::string::npos);
  EXPECT_NE(refusal("[variation]\nspeed_share = 2\n").find("[variation] speed_share is 2"),
            std::string::npos);
}

TEST(Scenario, nothing_given_is_a_64_beam_scanner_and_one_camera) {
  const Scenario scenario = parsed("");
  EXPECT_EQ(scenario.lidar.elevations.size(), 64U);
  ASSERT_EQ(scenario.cameras.size(), 1U);
  EXPECT_EQ(scenario.cameras[0].camera.label, "CAM0");
  EXPECT_EQ(scenario.cameras[0].camera.model.width, 1242);
  EXPECT_TRUE(scenario.vehicles.empty());
}

TEST(Scenario, sections_name_cameras_and_vehicles) {
  const Scenario scenario = parsed(
      "[lidar]\nrings = 3\nelevations_deg = 1 -10 -4\n"
      "[camera.LEFT]\nwidth = 640\nphase_s = 0.01\ngain = 0 1, 2 1.5\n"
      "[camera.REAR]\norientation_deg = 180 0 0\nlabel = back\n"
      "[vehicle.bus 5]\ntype = bus\nx_m = 4\nyaw_deg = 90\nspeed_mps = 3\nmotion = brake\n");
  EXPECT_NEAR(scenario.lidar.elevations[0], -10 * M_PI / 180, 1e-12);
  ASSERT_EQ(scenario.cameras.size(), 2U);
  EXPECT_EQ(scenario.cameras[0].camera.label, "LEFT");
  ASSERT_EQ(scenario.cameras[0].gain.size(), 2U);
  EXPECT_EQ(scenario.cameras[1].camera.label, "back");
  const Eigen::Vector3d viewed =
      scenario.cameras[1].camera.T_vehicle_camera.linear() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(viewed.x(), -1, 1e-12);
  ASSERT_EQ(scenario.vehicles.size(), 1U);
  EXPECT_NEAR(scenario.vehicles[0].motion.yaw, M_PI / 2, 1e-12);
  EXPECT_EQ(scenario.vehicles[0].motion.phases.size(), 1U);
}

TEST(Scenario, every_third_image_has_the_very_stamp_of_a_scan) {
  const auto images = stamps_of(30, 0, 10), scans = stamps_of(10, 0, 10);
  ASSERT_EQ(images.size(), 301U);
  ASSERT_EQ(scans.size(), 101U);
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(images[3 * i], scans[i]);
  EXPECT_EQ((images[1] - images[0]).count(), 333333);
}

// Whether a corner or the middle of a side of `a` lies within `b`, seen from above.
bool overlap(const World& world, int a, int b, double t) {
  const VehicleShape &of_a = world.objects[a].shape, &of_b = world.objects[b].shape;
  const Pose T_b_a = world.T_world_object(b, t).inverse() * world.T_world_object(a, t);
  for (const double x : {-0.5, 0., 0.5}) {
    for (const double y : {-0.5, 0., 0.5}) {
      const Eigen::Vector3d p = T_b_a * Eigen::Vector3d(x * of_a.length, y * of_a.width, 0);
      if (std::abs(p.x()) < 0.5 * of_b.length && std::abs(p.y()) < 0.5 * of_b.width) return true;
    }
  }
  return false;
}

// As written where the seed is 0.
void expect_nobody_overlaps(const std::filesystem::path& name, std::uint32_t seed) {
  const Scenario written = load_scenario(name.string());
  const Scenario scenario = seed == 0 ? written : drawn(written, seed);
  World world = build_world(scenario);
  Object ego = make_vehicle("car", 0);
  ego.motion = scenario.ego.motion;
  ego.id = static_cast<int>(world.objects.size());
  world.objects.push_back(ego);
  for (const Object& a : world.objects) {
    if (!a.moves()) continue;
    for (const Object& b : world.objects) {
      if (a.id == b.id || b.class_name.empty()) continue;
      for (int step = 0; step <= std::lround(scenario.duration_s * 10); ++step) {
        ASSERT_FALSE(overlap(world, a.id, b.id, 0.1 * step) ||
                     overlap(world, b.id, a.id, 0.1 * step))
            << name << ", seed " << seed << ": " << a.class_name << a.id << " and " << b.class_name
            << b.id << " at " << 0.1 * step << " s";
      }
    }
  }
}

TEST(Scenario, nobody_drives_through_anybody_in_those_that_are_shipped_whatever_the_seed) {
  for (const std::filesystem::path& name : shipped()) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) expect_nobody_overlaps(name, seed);
  }
}

TEST(Scenario, those_that_are_shipped_can_be_read) {
  EXPECT_GE(shipped().size(), 19U);
  for (const std::filesystem::path& name : shipped()) {
    const Scenario scenario = load_scenario(name.string());
    EXPECT_GE(scenario.vehicles.size(), 3U) << name;
    EXPECT_GT(build_world(scenario).objects.size(), 50U) << name;
  }
  EXPECT_THROW((void)load_scenario("no/such.ini"), std::runtime_error);
}

}  // namespace
}  // namespace lidar_upsampling::sim
