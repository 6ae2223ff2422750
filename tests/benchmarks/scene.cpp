// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scene.h"

#include <mrpt/config/CConfigFileMemory.h>

#include "simulator/camera.h"
#include "simulator/lidar.h"

namespace lidar_upsampling::bench {
namespace {

constexpr int kCycles = 4;
constexpr int kImagesPerScan = 3;
constexpr std::uint32_t kSeed = 3;

// The scanner is as the simulator has it, with a few columns more: 120 thousand of its beams
// return.
constexpr const char* kDrive = R"(
[scenario]
duration_s = 0.4
[ego]
y_m = -5.1
speed_mps = 10
[lidar]
columns = 2083
rate_hz = 10
[static]
crossing = false
parked_cars = 0.3
trees = 0.5
pedestrians = 0.2
[camera.CAM0]
rate_hz = 30
[vehicle.lead]
x_m = 16
y_m = -5.1
speed_mps = 12
[vehicle.left]
x_m = 11
y_m = -1.7
speed_mps = 13
[vehicle.left_van]
type = van
x_m = 30
y_m = -1.7
speed_mps = 9
[vehicle.far]
x_m = 38
y_m = -5.1
speed_mps = 10
[vehicle.oncoming]
x_m = 20
y_m = 1.7
yaw_deg = 180
speed_mps = 11
[vehicle.oncoming_bus]
type = bus
x_m = 42
y_m = 5.1
yaw_deg = 180
speed_mps = 10
[vehicle.oncoming_far]
x_m = 50
y_m = 1.7
yaw_deg = 180
speed_mps = 12
[vehicle.walker]
type = pedestrian
x_m = 18
y_m = -10.6
speed_mps = 1.4
)";

Scene make_scene() {
  mrpt::config::CConfigFileMemory config;
  config.setContent(kDrive);
  const sim::Scenario scenario = sim::scenario_from_config(config);
  const sim::CameraSpec& camera = scenario.cameras.front();
  Scene scene;
  scene.world = sim::build_world(scenario);
  scene.T_camera_lidar = camera.camera.T_vehicle_camera.inverse() * scenario.lidar.T_vehicle_lidar;
  const sim::CameraRenderer renderer(camera);
  for (int i = 0; i < kCycles; ++i) {
    const Stamp k = sim::stamp_of(i, scenario.lidar.rate_hz, 0);
    Cycle cycle{sim::scan_at(scene.world, scenario.lidar, k, kSeed).scan, {}};
    for (int j = 0; j < kImagesPerScan; ++j) {
      const Stamp t = sim::stamp_of(kImagesPerScan * i + j, camera.rate_hz, 0);
      cycle.images.push_back(renderer.render(scene.world, t, kSeed).image);
    }
    scene.cycles.push_back(std::move(cycle));
  }
  return scene;
}

}  // namespace

Pose Scene::T_lidar_t_lidar_k(Stamp k, Stamp t) const {
  const Pose& T_vehicle_lidar = cycles.front().scan.T_vehicle_lidar;
  const auto T_world_lidar = [&](Stamp stamp) {
    return world.T_world_vehicle(sim::time_of(stamp)) * T_vehicle_lidar;
  };
  return T_world_lidar(t).inverse() * T_world_lidar(k);
}

const Scene& scene() {
  static const Scene instance = make_scene();
  return instance;
}

Feed::Feed() { start(); }

void Feed::start() {
  upsampler_.emplace(Config{});
  const Cycle& first = scene().cycles.front();
  upsampler_->insert_scan(first.scan);
  for (const CameraImage& image : first.images) upsampler_->insert_image(image);
  next_ = 1;
}

const Cycle& Feed::next() {
  if (next_ == scene().cycles.size()) start();
  return scene().cycles[next_++];
}

}  // namespace lidar_upsampling::bench
