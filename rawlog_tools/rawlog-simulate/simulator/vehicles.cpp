// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <array>
#include <stdexcept>

#include "simulator/people.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// A hatchback, a saloon or a tall one.
VehicleShape car_shape(std::uint32_t seed) {
  VehicleShape s;
  if (seed % 3 == 1) {
    s.length = 4.6;
    s.rear_window_foot = -1.6;
    s.rear_window_top = -0.95;
  } else if (seed % 3 == 2) {
    s.width = 1.84;
    s.height = 1.68;
    s.clearance = 0.26;
    s.nose = 0.86;
    s.belt = 1.03;
    s.wheel_radius = 0.35;
    s.rear_window_foot = -1.98;
    s.rear_window_top = -1.65;
    s.lean = 0.28;
  }
  s.side_windows = {{-1.85, -0.5}, {-0.4, 1.0}};
  return s;
}

Vector3f color_of(const std::string& type, std::uint32_t seed) {
  static const std::array<Vector3f, 10> paints{
      Vector3f{0.50F, 0.03F, 0.025F}, Vector3f{0.03F, 0.09F, 0.36F}, Vector3f{0.66F, 0.67F, 0.68F},
      Vector3f{0.30F, 0.32F, 0.35F},  Vector3f{0.04F, 0.04F, 0.05F}, Vector3f{0.62F, 0.36F, 0.04F},
      Vector3f{0.05F, 0.24F, 0.13F},  Vector3f{0.10F, 0.30F, 0.42F}, Vector3f{0.42F, 0.38F, 0.30F},
      Vector3f{0.80F, 0.80F, 0.78F}};
  if (type == "bus") return {0.70F, 0.42F, 0.03F};
  if (type == "truck" || type == "van") return paints[seed % 2 == 0 ? 9 : (seed >> 3) % 10];
  return paints[(seed >> 4) % paints.size()];
}

Solid body_of(const VehicleShape& s) {
  const double front = 0.5 * s.length, side = 0.5 * s.width;
  Profile xz{{-front + 0.08, s.clearance},
             {front - 0.10, s.clearance},
             {front, s.clearance + 0.18},
             {front - 0.02, s.nose - 0.1},
             {front - 0.16, s.nose}};
  const double bonnet_end = std::min(s.windscreen_foot - 0.15, front - 0.3);
  xz.insert(xz.end(), {{bonnet_end, s.belt},
                       {-front + 0.22, s.belt + 0.03},
                       {-front + 0.03, s.belt - 0.12},
                       {-front, s.clearance + 0.25}});
  std::vector<Plane> planes;
  for (const double y : {-1., 1.}) {
    planes.push_back(plane_through({0, y * side, 0.62 * s.belt}, {0, y, 0.18}));
    planes.push_back(plane_through({0, y * side, s.clearance + 0.15}, {0, y, -0.35}));
    planes.push_back(plane_through({front - 0.28, y * side, 0}, {1, y * 0.55, 0}));
    planes.push_back(plane_through({-front + 0.2, y * side, 0}, {-1, y * 0.6, 0}));
  }
  return cut(extruded_along_y(xz, -side, side), planes);
}

Solid cabin_of(const VehicleShape& s) {
  const double foot = s.belt - 0.05, side = 0.5 * s.width - 0.04;
  const Profile xz{{s.rear_window_foot, foot},           {s.windscreen_foot, foot},
                   {s.windscreen_top, s.height - 0.05},  {s.windscreen_top - 0.22, s.height},
                   {s.rear_window_top + 0.25, s.height}, {s.rear_window_top, s.height - 0.06}};
  std::vector<Plane> planes;
  for (const double y : {-1., 1.}) {
    planes.push_back(plane_through({0, y * side, s.belt}, {0, y, s.lean}));
    planes.push_back(plane_through({0, y * (side - s.lean * (s.height - s.belt) - 0.06), s.height},
                                   {0, y, 1.1}));
    planes.push_back(
        plane_through({s.windscreen_foot - 0.12, y * side, foot},
                      {1, y * 0.35, (s.windscreen_foot - s.windscreen_top) / (s.height - s.belt)}));
  }
  return cut(extruded_along_y(xz, -side, side), planes);
}

Solid wheel_of(const VehicleShape& s, double x, double side) {
  Profile circle;
  for (int i = 0; i < 18; ++i) {
    const double angle = 2 * M_PI * i / 18;
    circle.emplace_back(x + s.wheel_radius * std::cos(angle),
                        s.wheel_radius * (1 + std::sin(angle)));
  }
  const double outer = 0.5 * s.width + 0.012, inner = outer - 0.22;
  return side > 0 ? extruded_along_y(circle, inner, outer)
                  : extruded_along_y(circle, -outer, -inner);
}

void add_details(Object& object, const Vector3f& color) {
  const VehicleShape& s = object.shape;
  for (const double y : {-1., 1.}) {
    const Vector3d mirror(s.windscreen_foot - 0.3, y * (0.5 * s.width + 0.06), s.belt + 0.1);
    object.parts.push_back({ellipsoid(mirror, {0.07, 0.12, 0.08}), Material::metal, color});
  }
  if (s.cargo_to > s.cargo_from) {
    const double side = 0.5 * s.width;
    object.parts.push_back({box({s.cargo_from, -side, 0.95}, {s.cargo_to, side, s.height}),
                            Material::cargo, Vector3f(0.72F, 0.73F, 0.74F)});
  }
}

}  // namespace

VehicleShape vehicle_shape(const std::string& type, std::uint32_t seed) {
  if (type == "pedestrian") return make_pedestrian(seed).shape;
  if (type == "cyclist") return make_cyclist(seed).shape;
  VehicleShape s;
  if (type == "car") {
    s = car_shape(seed);
  } else if (type == "van") {
    s = {5.2, 1.95, 2.15, 0.25, 1.0, 1.2, 0.35, 1.65, -1.5, 1.9, 1.05, -2.55, -2.5, 0.12, 0, 0, {}};
    s.side_windows = {{0.35, 1.8}};
  } else if (type == "truck") {
    s = {7.8,  2.45, 3.3, 0.45, 1.45, 1.5,  0.48, 2.6, -2.2,
         3.75, 3.55, 1.9, 1.95, 0.05, -3.9, 1.75, {}};
    s.side_windows = {{2.3, 3.5}};
  } else if (type == "bus") {
    s = {11.2, 2.5,  3.05, 0.35,  1.15, 1.25, 0.48, 3.3, -2.9,
         5.5,  5.35, -5.5, -5.45, 0.04, 0,    0,    {}};
    for (int i = 0; i < 7; ++i) s.side_windows.emplace_back(-5.2 + 1.5 * i, -3.8 + 1.5 * i);
  } else {
    throw std::invalid_argument("vehicle type \"" + type +
                                "\": it can be car, van, truck, bus, pedestrian, cyclist");
  }
  return s;
}

Object make_vehicle(const std::string& type, std::uint32_t seed,
                    const std::optional<Vector3f>& color) {
  if (type == "pedestrian") return make_pedestrian(seed);
  if (type == "cyclist") return make_cyclist(seed);
  Object object;
  object.class_name = type;
  object.seed = seed;
  object.shape = vehicle_shape(type, seed);
  const Vector3f paint = color.value_or(color_of(type, seed));
  object.parts.push_back({body_of(object.shape), Material::body, paint});
  object.parts.push_back({cabin_of(object.shape), Material::cabin, paint});
  for (const double x : {object.shape.front_axle, object.shape.rear_axle}) {
    for (const double side : {-1., 1.}) {
      object.parts.push_back(
          {wheel_of(object.shape, x, side), Material::wheel, Vector3f::Constant(0.025F)});
    }
  }
  add_details(object, paint);
  return object;
}

}  // namespace lidar_upsampling::sim
