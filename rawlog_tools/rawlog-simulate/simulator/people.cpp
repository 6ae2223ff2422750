// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/people.h"

#include <cmath>

#include "simulator/noise.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

const Vector3f kSkin(0.55F, 0.33F, 0.24F);

struct Clothes {
  Vector3f coat, trousers;
};

Clothes clothes_of(std::uint32_t seed) {
  const auto tint = [&](std::uint32_t i) {
    return static_cast<float>(0.05 + 0.5 * uniform(seed, i));
  };
  return {{tint(1), tint(2), tint(3)}, {tint(4) * 0.4F, tint(4) * 0.4F, tint(5) * 0.5F}};
}

// A flat bar between two points of the (x, z) plane, `y` being its middle and `width` its size
// along y; its ends are as thick as told.
Solid bar(const Vector2d& from, const Vector2d& to, const Vector2d& thickness,
          const Vector2d& y_and_width) {
  const Vector2d along = (to - from).normalized(), left(-along.y(), along.x());
  const Profile xz{from - 0.5 * thickness[0] * left, to - 0.5 * thickness[1] * left,
                   to + 0.5 * thickness[1] * left, from + 0.5 * thickness[0] * left};
  return extruded_along_y(xz, y_and_width[0] - 0.5 * y_and_width[1],
                          y_and_width[0] + 0.5 * y_and_width[1]);
}

void add_bicycle(Object& object, const Vector3f& paint) {
  const VehicleShape& s = object.shape;
  for (const double axle : {s.front_axle, s.rear_axle}) {
    Profile circle;
    for (int i = 0; i < 18; ++i) {
      const double angle = M_PI * (i / 9. - 0.5);
      circle.emplace_back(axle + s.wheel_radius * std::cos(angle),
                          s.wheel_radius * (1 + std::sin(angle)));
    }
    object.parts.push_back(
        {extruded_along_y(circle, -0.02, 0.02), Material::wheel, Vector3f::Constant(0.025F)});
  }
  const Vector2d rear(s.rear_axle, s.wheel_radius), front(s.front_axle, s.wheel_radius);
  const Vector2d crank(-0.05, 0.3), saddle(-0.22, 0.9), head(0.38, 0.85), grip(0.4, 1.02);
  const Vector2d thin(0.04, 0.04), flat(0, 0.05);
  for (const auto& [from, to] :
       {std::pair(crank, saddle), std::pair(crank, head), std::pair(saddle, head),
        std::pair(rear, crank), std::pair(rear, saddle), std::pair(front, grip)}) {
    object.parts.push_back({bar(from, to, thin, flat), Material::metal, paint});
  }
  const double reach = 0.5 * s.width;
  object.parts.push_back(
      {box({0.36, -reach, 1.0}, {0.41, reach, 1.04}), Material::metal, Vector3f::Constant(0.05F)});
  object.parts.push_back(
      {box({-0.34, -0.08, 0.88}, {-0.1, 0.08, 0.94}), Material::cloth, Vector3f::Constant(0.03F)});
}

// Leans forward, one foot down and one up.
void add_rider(Object& object, const Clothes& clothes, const Vector3f& helmet) {
  const Vector2d hip(-0.2, 0.95), shoulder(0.1, 1.42), hand(0.37, 1.06);
  const auto cloth = [&](const Solid& solid, const Vector3f& color) {
    object.parts.push_back({solid, Material::cloth, color});
  };
  cloth(bar(hip, shoulder, {0.22, 0.24}, {0, 0.36}), clothes.coat);
  for (const double side : {-1., 1.}) {
    const Vector2d knee(0.16, side > 0 ? 0.62 : 0.82), foot(-0.02, side > 0 ? 0.16 : 0.44);
    cloth(bar(hip, knee, {0.18, 0.13}, {0.11 * side, 0.13}), clothes.trousers);
    cloth(bar(knee, foot, {0.12, 0.09}, {0.12 * side, 0.1}), clothes.trousers);
    cloth(bar(shoulder, hand, {0.11, 0.07}, {0.21 * side, 0.09}), clothes.coat);
  }
  object.parts.push_back({ellipsoid({0.2, 0, 1.57}, {0.11, 0.09, 0.14}), Material::skin, kSkin});
  object.parts.push_back({ellipsoid({0.18, 0, 1.64}, {0.14, 0.11, 0.11}), Material::metal, helmet});
}

}  // namespace

Object make_pedestrian(std::uint32_t seed) {
  Object object;
  object.class_name = "pedestrian";
  object.seed = seed;
  object.shape.length = 0.5;
  object.shape.width = 0.5;
  object.shape.height = 1.76;
  const Clothes clothes = clothes_of(seed);
  for (const double y : {-0.1, 0.1}) {
    object.parts.push_back(
        {upright_prism({y * 0.8, y, 0}, 0.07, 0.1, 0.85, 8), Material::cloth, clothes.trousers});
  }
  object.parts.push_back(
      {upright_prism({0, 0, 0.8}, 0.2, 0.23, 0.62, 10), Material::cloth, clothes.coat});
  object.parts.push_back(
      {ellipsoid({0, 0, 1.44}, {0.17, 0.23, 0.1}), Material::cloth, clothes.coat});
  object.parts.push_back({ellipsoid({0.02, 0, 1.62}, {0.11, 0.1, 0.14}), Material::skin, kSkin});
  return object;
}

Object make_cyclist(std::uint32_t seed) {
  Object object;
  object.class_name = "cyclist";
  object.seed = seed;
  VehicleShape& s = object.shape;
  s.length = 1.8;
  s.width = 0.6;
  s.height = 1.75;
  s.wheel_radius = 0.35;
  s.front_axle = 0.55;
  s.rear_axle = -0.55;
  const auto tint = [&](std::uint32_t i) {
    return static_cast<float>(0.04 + 0.6 * uniform(seed, i));
  };
  add_bicycle(object, {tint(6), tint(7), tint(8)});
  add_rider(object, clothes_of(seed), {tint(9), tint(10), tint(11)});
  return object;
}

}  // namespace lidar_upsampling::sim
