// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/motion.h"
#include "simulator/scenario.h"
#include "simulator/solid.h"

namespace lidar_upsampling::sim {

enum class Material : std::uint8_t {
  asphalt,
  pavement,
  facade,
  roof,
  bark,
  foliage,
  metal,
  sign,
  body,
  cabin,
  cargo,
  wheel,
  awning,
  cloth,
  skin
};

struct Part {
  Solid solid;
  Material material = Material::metal;
  Eigen::Vector3f color = Eigen::Vector3f::Constant(0.5F);  ///< linear RGB, 0 to 1
};

/// What a vehicle's paint needs to know of its shape: metres, origin on the ground under its
/// middle, +X forward.
struct VehicleShape {
  double length = 4.3, width = 1.78, height = 1.48;
  double clearance = 0.2;
  double nose = 0.7;  ///< height of the bonnet's front edge
  double belt = 0.9;  ///< height where the windows begin
  double wheel_radius = 0.32, front_axle = 1.3, rear_axle = -1.3;
  double windscreen_foot = 1.0, windscreen_top = 0.2;
  double rear_window_foot = -1.85, rear_window_top = -1.3;
  double lean = 0.36;                   ///< of the cabin's sides, inwards per metre of height
  double cargo_from = 0, cargo_to = 0;  ///< along x, of a box behind the cabin
  std::vector<std::pair<double, double>> side_windows;
};

/// A rigid thing. Its frame has +Z up, and its origin on the ground.
struct Object {
  int id = 0;
  std::string class_name;  ///< of traffic participants; empty for what stands for good
  std::uint32_t seed = 0;  ///< of its texture
  float grain = 1;         ///< contrast of its fine pattern
  VehicleShape shape;      ///< of traffic participants
  std::vector<Part> parts;
  MotionProfile motion;

  [[nodiscard]] bool moves() const { return motion.speed > 0 || !motion.phases.empty(); }
};

/// @brief What a make_vehicle() of this type and seed is like. @throw std::invalid_argument another
/// type.
[[nodiscard]] VehicleShape vehicle_shape(const std::string& type, std::uint32_t seed);

/// @param type car, van, truck, bus, pedestrian or cyclist. `color` by the seed where none is
/// given, and people's always.
/// @throw std::invalid_argument another type.
[[nodiscard]] Object make_vehicle(const std::string& type, std::uint32_t seed,
                                  const std::optional<Eigen::Vector3f>& color = std::nullopt);

/// Everything there is, the ego vehicle excepted. Objects' ids are their places in `objects`.
struct World {
  StreetSpec street;
  AppearanceSpec appearance;
  EgoSpec ego;
  std::vector<Object> objects;

  [[nodiscard]] Pose T_world_object(int id, double t) const;
  /// With the body's sway and heave.
  [[nodiscard]] Pose T_world_vehicle(double t) const;
};

/// Of the vehicle's shape and texture, where a scenario's seed is that.
[[nodiscard]] std::uint32_t vehicle_seed(std::uint32_t seed, std::size_t index);

[[nodiscard]] World build_world(const Scenario& scenario);

/// Ground, pavements, buildings, trees, poles, and parked vehicles, as far as a sensor sees from
/// x_from to x_to.
[[nodiscard]] std::vector<Object> build_street(const StreetSpec& street, double x_from, double x_to,
                                               std::uint32_t seed);

/// Half the width of the carriageway, parking lanes included; there the pavements begin.
[[nodiscard]] double kerb_y(const StreetSpec& street);
/// Half the width of the side street.
constexpr double kCrossingHalfWidth = 5;

}  // namespace lidar_upsampling::sim
