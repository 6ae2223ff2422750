// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lidar_upsampling/upsampler.h"
#include "simulator/camera.h"
#include "simulator/lidar.h"
#include "simulator/world.h"

namespace lidar_upsampling {

/// A street seen by a small rig: a car ahead that moves on, an oncoming one, a parked one.
inline constexpr const char* kStreet = R"(
[scenario]
duration_s = 0.5
[ego]
y_m = -1.7
speed_mps = 8
[lidar]
rings = 48
fov_up_deg = 3
fov_down_deg = -24
columns = 900
noise_m = 0.01
[static]
parked_cars = 0.3
trees = 0.2
pedestrians = 0
crossing = false
[camera.CAM0]
width = 621
height = 188
fx = 360
rate_hz = 30
[vehicle.lead]
x_m = 14
y_m = -1.7
speed_mps = 11
[vehicle.oncoming]
x_m = 30
y_m = 1.7
yaw_deg = 180
speed_mps = 9
)";

/// The same with fewer beams and pixels, for a shorter time: enough for what comes when, and quick
/// enough for sanitizers.
inline constexpr const char* kSmallRig = R"(
[scenario]
duration_s = 0.3
[lidar]
rings = 32
columns = 450
[camera.CAM0]
width = 414
height = 125
fx = 240
)";

/// Settings that leave every virtual point the real one that it was, so that each has its truth.
inline Config moving_points() {
  Config config;
  config.resample = "none";
  return config;
}

/// Scans and images of a simulated street, fed to an upsampler in the order of their stamps.
class StreetRun {
 public:
  /// @param changes further INI text; sections may be given again.
  explicit StreetRun(const std::string& changes = {}) {
    mrpt::config::CConfigFileMemory config;
    config.setContent(kStreet + changes);
    scenario = sim::scenario_from_config(config);
    world = sim::build_world(scenario);
    for (const sim::CameraSpec& camera : scenario.cameras) renderers_.emplace_back(camera);
  }

  [[nodiscard]] const sim::SimulatedScan& scan_at(Stamp stamp) const {
    const auto [scan, is_new] = scans_.try_emplace(stamp);
    if (is_new) scan->second = sim::scan_at(world, scenario.lidar, stamp, 7);
    return scan->second;
  }

  [[nodiscard]] const CameraImage& picture_at(int camera, Stamp stamp) const {
    const auto [picture, is_new] = pictures_.try_emplace({camera, stamp});
    if (is_new) picture->second = renderers_[camera].render(world, stamp, 7).image;
    return picture->second;
  }

  /// True motion of a world object's points (or, with -1, of the static world) between two
  /// instants, in the lidar frame.
  [[nodiscard]] Pose true_motion(int object, Stamp from, Stamp to) const {
    const double t0 = sim::time_of(from), t1 = sim::time_of(to);
    const Pose T_world_lidar_0 = world.T_world_vehicle(t0) * scenario.lidar.T_vehicle_lidar;
    const Pose T_world_lidar_1 = world.T_world_vehicle(t1) * scenario.lidar.T_vehicle_lidar;
    const Pose T_object =
        object < 0 ? Pose::Identity()
                   : world.T_world_object(object, t1) * world.T_world_object(object, t0).inverse();
    return T_world_lidar_1.inverse() * T_object * T_world_lidar_0;
  }

  /// Feeds everything; `with_poses` gives the true poses to the ego-motion, `with_next_scans` the
  /// next scans beforehand.
  std::vector<VirtualScan> run(LidarUpsampler& upsampler, bool with_poses = true,
                               bool with_next_scans = false) {
    struct Event {
      Stamp stamp;
      int camera;  // -1: the lidar
    };
    std::vector<Event> events;
    const auto scans =
        sim::stamps_of(scenario.lidar.rate_hz, scenario.lidar.phase_s, scenario.duration_s);
    events.reserve(scans.size());
    for (const Stamp stamp : scans) events.push_back({stamp, -1});
    for (int i = 0; i < static_cast<int>(scenario.cameras.size()); ++i) {
      const sim::CameraSpec& camera = scenario.cameras[i];
      for (const Stamp stamp : sim::stamps_of(camera.rate_hz, camera.phase_s, scenario.duration_s))
        events.push_back({stamp, i});
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.stamp < b.stamp; });
    upsampler.expect_scans(scans);
    if (with_poses)
      for (const Stamp stamp : sim::stamps_of(100, 0, scenario.duration_s + 0.02))
        upsampler.ego_motion().add_pose({stamp, world.T_world_vehicle(sim::time_of(stamp))});

    constexpr double kAhead_s = 0.35;
    std::size_t num_expected = 0;
    std::vector<VirtualScan> virtual_scans;
    const auto take = [&](std::optional<VirtualScan> scan) {
      if (scan) virtual_scans.push_back(std::move(*scan));
    };
    for (const Event& event : events) {
      if (event.camera >= 0) {
        take(upsampler.insert_image(picture_at(event.camera, event.stamp),
                                    event.stamp < hurried_from || event.stamp > hurried_until
                                        ? Effort::full
                                        : Effort::prediction));
        continue;
      }
      for (; with_next_scans && num_expected < scans.size() &&
             scans[num_expected] <= shifted(event.stamp, kAhead_s);
           ++num_expected)
        upsampler.expect(scan_at(scans[num_expected]).scan);
      take(upsampler.insert_scan(scan_at(event.stamp).scan));
    }
    take(upsampler.flush());
    return virtual_scans;
  }

  sim::Scenario scenario;
  sim::World world;
  Stamp hurried_from = Stamp::max(), hurried_until = Stamp::max();

 private:
  std::vector<sim::CameraRenderer> renderers_;
  // To simulate them takes most of a test's time, and some ask for them several times.
  mutable std::map<Stamp, sim::SimulatedScan> scans_;
  mutable std::map<std::pair<int, Stamp>, CameraImage> pictures_;
};

/// Mean distance of a virtual scan's points from where the truth puts them, those of moving objects
/// and all others apart; negative if there are none.
struct PointErrors {
  double moving = -1, standing = -1;
};

inline PointErrors point_errors(const StreetRun& street, const VirtualScan& scan) {
  const sim::SimulatedScan& key = street.scan_at(scan.key_stamp);
  double sums[2] = {0, 0};
  int counts[2] = {0, 0};
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const int source = scan.source_index[i];
    const int object = key.object[source];
    const int moves = object >= 0 && street.world.objects[object].moves() ? 1 : 0;
    const Eigen::Vector3d truth =
        street.true_motion(moves != 0 ? object : -1, scan.key_stamp, scan.scan.stamp) *
        key.scan.points[source].cast<double>();
    sums[moves] += (scan.scan.points[i].cast<double>() - truth).norm();
    ++counts[moves];
  }
  PointErrors errors;
  if (counts[0] > 0) errors.standing = sums[0] / counts[0];
  if (counts[1] > 0) errors.moving = sums[1] / counts[1];
  return errors;
}

}  // namespace lidar_upsampling
