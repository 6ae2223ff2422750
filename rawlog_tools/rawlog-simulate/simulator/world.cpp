// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/world.h"

#include <algorithm>

#include "simulator/footprint.h"
#include "simulator/noise.h"

namespace lidar_upsampling::sim {

namespace {

constexpr double kSight = 130;

Object vehicle_of(const VehicleSpec& spec, std::uint32_t seed) {
  Object object = make_vehicle(spec.type, seed, spec.color);
  object.motion = spec.motion;
  return object;
}

// Whoever parks or waits where the traffic is to pass is not there.
void clear_way(std::vector<Object>& street, const Scenario& scenario) {
  constexpr double kGap = 0.3;
  std::vector<Footprint> traffic{ego_footprint(scenario.ego)};
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    const VehicleSpec& spec = scenario.vehicles[i];
    const VehicleShape shape = vehicle_shape(spec.type, vehicle_seed(scenario.seed, i));
    traffic.push_back({shape.length, shape.width, spec.motion});
  }
  const auto in_the_way = [&](const Object& object) {
    return !object.class_name.empty() &&
           std::any_of(traffic.begin(), traffic.end(), [&](const Footprint& footprint) {
             return ever_touch(footprint, footprint_of(object), scenario.cleared_s, kGap);
           });
  };
  street.erase(std::remove_if(street.begin(), street.end(), in_the_way), street.end());
}

}  // namespace

std::uint32_t vehicle_seed(std::uint32_t seed, std::size_t index) {
  return hash(seed, static_cast<std::uint32_t>(1000 + index));
}

Pose World::T_world_object(int id, double t) const {
  const Object& object = objects.at(id);
  return state_at(object.motion, t).pose();
}

Pose World::T_world_vehicle(double t) const {
  Pose T = state_at(ego.motion, t).pose();
  T.translation().z() = ego.heave * std::sin(2 * M_PI * 1.3 * t);
  T.rotate(Eigen::AngleAxisd(ego.pitch_sway * std::sin(2 * M_PI * 0.9 * t + 0.4),
                             Eigen::Vector3d::UnitY()));
  T.rotate(Eigen::AngleAxisd(ego.roll_sway * std::sin(2 * M_PI * 0.7 * t + 1.1),
                             Eigen::Vector3d::UnitX()));
  return T;
}

World build_world(const Scenario& scenario) {
  World world;
  world.street = scenario.street;
  world.appearance = scenario.appearance;
  world.ego = scenario.ego;
  double x_from = scenario.ego.motion.x, x_to = x_from;
  const int half_seconds = static_cast<int>(2 * scenario.duration_s);
  for (int i = 0; i <= half_seconds; ++i) {
    const double x = state_at(scenario.ego.motion, 0.5 * i).x;
    x_from = std::min(x_from, x);
    x_to = std::max(x_to, x);
  }
  world.objects = build_street(scenario.street, x_from - kSight, x_to + kSight, scenario.seed);
  if (scenario.cleared_s > 0) clear_way(world.objects, scenario);
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    world.objects.push_back(vehicle_of(scenario.vehicles[i], vehicle_seed(scenario.seed, i)));
  }
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    world.objects[i].id = static_cast<int>(i);
    world.objects[i].grain = static_cast<float>(scenario.appearance.grain);
  }
  return world;
}

}  // namespace lidar_upsampling::sim
