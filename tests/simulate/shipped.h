// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "simulator/variation.h"
#include "test_world.h"

namespace lidar_upsampling::sim {

/// A shipped scenario, as written (seed 0) or as a seed draws it, and what its LiDAR sees of it.
struct Shipped {
  Scenario scenario;
  World world;
  int num_scans_in_all = 0;
  std::vector<Stamp> stamps;           ///< of the scans
  std::vector<std::vector<int>> hits;  ///< points of each vehicle, per scan

  explicit Shipped(const std::string& name, std::uint32_t seed = 0, int every = 1)
      : scenario(loaded(name, seed)),
        world(build_world(scenario)),
        stamps(stamps_of(scenario.lidar.rate_hz, scenario.lidar.phase_s, scenario.duration_s)) {
    // Who sees what is asked at one instant each.
    LidarSpec lidar = scenario.lidar;
    lidar.sweep = false;
    // A third of the columns tells as much of a seed; each point then counts thrice.
    const int weight = seed == 0 || lidar.depth_camera ? 1 : 3;
    lidar.columns /= weight;
    num_scans_in_all = static_cast<int>(stamps.size());
    for (int i = 0; every * i < num_scans_in_all; ++i) stamps[i] = stamps[every * i];
    stamps.resize((stamps.size() + every - 1) / every);
    for (const Stamp stamp : stamps) {
      const SimulatedScan scan = scan_at(world, lidar, stamp, scenario.seed);
      std::vector<int> points(world.objects.size(), 0);
      for (const int object : scan.object) points[object] += weight;
      hits.emplace_back(points.begin() + first_vehicle(), points.end());
    }
  }

  static Scenario loaded(const std::string& name, std::uint32_t seed) {
    const Scenario written = load_scenario(SCENARIO_FOLDER "/" + name + ".ini");
    return seed == 0 ? written : drawn(written, seed);
  }
  [[nodiscard]] int num_vehicles() const { return static_cast<int>(scenario.vehicles.size()); }
  [[nodiscard]] int first_vehicle() const {
    return static_cast<int>(world.objects.size()) - num_vehicles();
  }
  [[nodiscard]] MotionState ego_at(double t) const { return state_at(scenario.ego.motion, t); }
  [[nodiscard]] MotionState vehicle_at(int vehicle, double t) const {
    return state_at(scenario.vehicles[vehicle].motion, t);
  }
  [[nodiscard]] bool is(int vehicle, const std::string& type) const {
    return scenario.vehicles[vehicle].type == type;
  }
  /// From middle to middle.
  [[nodiscard]] double distance(int vehicle, double t) const {
    const MotionState other = vehicle_at(vehicle, t), ego = ego_at(t);
    return std::hypot(other.x - ego.x, other.y - ego.y);
  }
  /// Within 40 m, its middle on the picture, and enough points to be found.
  [[nodiscard]] bool in_view(int vehicle, std::size_t scan, int fewest_points = 20,
                             std::size_t camera = 0) const {
    const Camera& seen_by = scenario.cameras[camera].camera;
    const double t = time_of(stamps[scan]);
    const Eigen::Vector3d p = (world.T_world_vehicle(t) * seen_by.T_vehicle_camera).inverse() *
                              (vehicle_at(vehicle, t).pose() * Eigen::Vector3d(0, 0, 0.8));
    const double u = seen_by.model.fx * p.x() / p.z() + seen_by.model.cx;
    return p.z() > 0 && p.z() < 40 && u >= 0 && u < seen_by.model.width &&
           hits[scan][vehicle] >= fewest_points;
  }
  /// In how many scans a vehicle is in view while `holds(vehicle, t)`.
  template <typename Condition>
  [[nodiscard]] int num_scans(int vehicle, const Condition& holds) const {
    int count = 0;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      count += in_view(vehicle, i) && holds(vehicle, time_of(stamps[i])) ? 1 : 0;
    }
    return count;
  }
  /// How many vehicles do so in at least so many scans.
  template <typename Condition>
  [[nodiscard]] int num_vehicles_that(int fewest_scans, const Condition& holds) const {
    int count = 0;
    for (int v = 0; v < num_vehicles(); ++v) count += num_scans(v, holds) >= fewest_scans ? 1 : 0;
    return count;
  }
};

}  // namespace lidar_upsampling::sim
