// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/noise.h"
#include "simulator/world.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kKerbHeight = 0.12, kPavement = 3.5, kBuildingDepth = 9;

/// A place for something along the street: `side` is +1 on the left (y > 0), -1 on the right.
struct Place {
  double x = 0;
  double side = 1;
  std::uint32_t seed = 0;
};

bool near_crossing(const StreetSpec& street, double x, double margin) {
  return std::abs(x - street.crossing_x) < kCrossingHalfWidth + margin;
}

// Places every `spacing` metres on both sides, of which `share` are taken, the crossing kept free.
std::vector<Place> places(const StreetSpec& street, const Eigen::Vector2d& x_range, double spacing,
                          double share, std::uint32_t seed) {
  std::vector<Place> taken;
  for (const double side : {-1., 1.}) {
    const auto first = static_cast<int>(std::floor(x_range[0] / spacing));
    const auto last = static_cast<int>(std::ceil(x_range[1] / spacing));
    for (int i = first; i <= last; ++i) {
      const std::uint32_t own = hash(seed + (side > 0 ? 1 : 0), static_cast<std::uint32_t>(i));
      const double x = spacing * (i + 0.2 * (uniform(own, 1) - 0.5));
      if (uniform(own, 2) < share && !near_crossing(street, x, 4.5)) {
        taken.push_back({x, side, own});
      }
    }
  }
  return taken;
}

Object standing_at(double x, double y, double yaw, std::uint32_t seed) {
  Object object;
  object.motion.x = x;
  object.motion.y = y;
  object.motion.yaw = yaw;
  object.seed = seed;
  return object;
}

Object make_ground(const StreetSpec& street) {
  Object ground = standing_at(0, 0, 0, 7);
  ground.parts.push_back(
      {intersection({{Vector3d::UnitZ(), 0}}), Material::asphalt, Vector3f::Constant(0.16F)});
  const Plane top{Vector3d::UnitZ(), kKerbHeight};
  const Vector3f stone(0.36F, 0.35F, 0.33F);
  for (const double side : {-1., 1.}) {
    const Plane kerb{-side * Vector3d::UnitY(), -kerb_y(street)};
    if (std::isnan(street.crossing_x)) {
      ground.parts.push_back({intersection({top, kerb}), Material::pavement, stone});
      continue;
    }
    for (const double end : {-1., 1.}) {
      const Plane corner{-end * Vector3d::UnitX(), -end * street.crossing_x - kCrossingHalfWidth};
      ground.parts.push_back({intersection({top, kerb, corner}), Material::pavement, stone});
    }
  }
  return ground;
}

Object make_building(double x_from, double x_to, double facade_y, double side, std::uint32_t seed) {
  static const std::array<Vector3f, 7> walls{
      Vector3f{0.62F, 0.50F, 0.34F}, Vector3f{0.55F, 0.33F, 0.24F}, Vector3f{0.60F, 0.57F, 0.50F},
      Vector3f{0.68F, 0.56F, 0.30F}, Vector3f{0.42F, 0.46F, 0.47F}, Vector3f{0.58F, 0.42F, 0.36F},
      Vector3f{0.50F, 0.54F, 0.44F}};
  Object building = standing_at(0.5 * (x_from + x_to), side * facade_y, side > 0 ? 0 : M_PI, seed);
  const double half = 0.5 * (x_to - x_from), depth = kBuildingDepth;
  const double height = 4.1 + 3.1 * (1 + static_cast<int>(uniform(seed, 1) * 3.2)) + 0.5;
  const Vector3f& wall = walls[hash(seed, 2) % walls.size()];
  auto& parts = building.parts;
  parts.push_back({box({-half, 0, 0}, {half, depth, height}), Material::facade, wall});
  parts.push_back({box({-half, -0.28, height - 0.4}, {half, 0.1, height}), Material::metal,
                   Vector3f(wall * 1.15F)});
  parts.push_back(
      {extruded_along_x({{-0.4, height}, {depth + 0.4, height}, {0.5 * depth, height + 3}}, -half,
                        half),
       Material::roof, Vector3f(0.34F, 0.12F, 0.07F)});
  if (uniform(seed, 3) < 0.55) {
    static const std::array<Vector3f, 4> cloths{Vector3f{0.5F, 0.05F, 0.05F},
                                                {0.05F, 0.25F, 0.15F},
                                                {0.08F, 0.12F, 0.4F},
                                                {0.55F, 0.3F, 0.04F}};
    const double reach = std::min(half - 1, 3.5);
    parts.push_back({extruded_along_x({{-1.2, 2.75}, {0, 2.7}, {0, 3.3}}, -reach, reach),
                     Material::awning, cloths[hash(seed, 4) % cloths.size()]});
  }
  for (int floor = 1; 4.1 + 3.1 * floor < height - 1; ++floor) {
    if (uniform(seed, 10 + floor) > 0.5) continue;
    const double x = std::floor((uniform(seed, 20 + floor) - 0.5) * (half - 1.5)) * 2.4 / 1.2;
    const double reach = std::min(1.1, half - std::abs(x));
    if (reach < 0.5) continue;
    parts.push_back({box({x - reach, -0.9, 1. + 3.1 * floor}, {x + reach, 0, 1.95 + 3.1 * floor}),
                     Material::metal, Vector3f(wall * 0.55F)});
  }
  return building;
}

void add_buildings(std::vector<Object>& objects, const StreetSpec& street,
                   const Eigen::Vector2d& x_range, std::uint32_t seed) {
  const double gap_from = street.crossing_x - kCrossingHalfWidth - kPavement;
  const double gap_to = street.crossing_x + kCrossingHalfWidth + kPavement;
  for (const double side : {-1., 1.}) {
    double x = x_range[0];
    for (std::uint32_t i = 0; x < x_range[1]; ++i) {
      const std::uint32_t own = hash(seed + (side > 0 ? 51 : 50), i);
      double end = x + 9 + 7 * uniform(own, 1);
      if (x < gap_from && end > gap_from - 6) end = gap_from;
      if (uniform(own, 2) < street.buildings) {
        objects.push_back(make_building(x, end, kerb_y(street) + kPavement, side, own));
      }
      x = x < gap_from && end >= gap_from ? gap_to : end;
    }
  }
}

Object make_tree(double x, double y, std::uint32_t seed) {
  Object tree = standing_at(x, y, 2 * M_PI * uniform(seed, 1), seed);
  const double trunk = 2.3 + 0.7 * uniform(seed, 2), size = 0.85 + 0.4 * uniform(seed, 3);
  tree.parts.push_back({upright_prism({0, 0, 0}, 0.17 * size, 0.1 * size, trunk + size, 8),
                        Material::bark, Vector3f(0.12F, 0.08F, 0.05F)});
  constexpr std::uint32_t num_lumps = 26;
  for (std::uint32_t i = 0; i < num_lumps; ++i) {
    // Lumps wind up around an egg.
    const double up = (i + 0.5) / num_lumps, angle = 2.4 * i;
    const double reach =
        size * 1.35 * std::sin(M_PI * std::pow(up, 0.8)) * (0.75 + 0.35 * uniform(seed, 30 + i));
    const Vector3d center(reach * std::cos(angle), reach * std::sin(angle),
                          trunk + size * (0.3 + 3. * up));
    const double radius = size * (0.5 + 0.35 * uniform(seed, 50 + i)) * (1.15 - 0.4 * up);
    const auto shade = static_cast<float>(0.75 + 0.5 * uniform(seed, 70 + i));
    tree.parts.push_back({ellipsoid(center, {radius, radius, 0.85 * radius}), Material::foliage,
                          Vector3f(0.10F, 0.19F, 0.04F) * shade});
  }
  tree.parts.push_back({ellipsoid({0, 0, trunk + 1.7 * size}, {1.2 * size, 1.2 * size, 1.5 * size}),
                        Material::foliage, Vector3f(0.06F, 0.12F, 0.025F)});
  return tree;
}

Object make_lamp(double x, double y, double side, std::uint32_t seed) {
  Object lamp = standing_at(x, y, side > 0 ? -M_PI / 2 : M_PI / 2, seed);
  const Vector3f paint(0.10F, 0.14F, 0.13F);
  lamp.parts.push_back({upright_prism({0, 0, 0}, 0.1, 0.05, 7, 8), Material::metal, paint});
  lamp.parts.push_back({box({0, -0.04, 6.9}, {1.7, 0.04, 6.98}), Material::metal, paint});
  lamp.parts.push_back(
      {box({1.1, -0.14, 6.8}, {1.9, 0.14, 6.95}), Material::metal, Vector3f::Constant(0.6F)});
  return lamp;
}

Object make_sign(double x, double y, double yaw, std::uint32_t seed) {
  Object sign = standing_at(x, y, yaw, seed);
  sign.parts.push_back(
      {upright_prism({0, 0, 0}, 0.035, 0.035, 2.9, 6), Material::metal, Vector3f::Constant(0.35F)});
  Profile round;
  for (int i = 0; i < 16; ++i) {
    round.emplace_back(0.33 * std::cos(M_PI * i / 8), 2.55 + 0.33 * std::sin(M_PI * i / 8));
  }
  sign.parts.push_back(
      {extruded_along_x(round, -0.06, -0.03), Material::sign,
       uniform(seed, 1) < 0.5 ? Vector3f(0.6F, 0.02F, 0.02F) : Vector3f(0.02F, 0.1F, 0.5F)});
  return sign;
}

void add_hills(std::vector<Object>& objects, const Eigen::Vector2d& x_range, std::uint32_t seed) {
  for (std::uint32_t i = 0; i < 10; ++i) {
    const double x = i % 2 == 0 ? x_range[1] + 120 : x_range[0] - 120;
    const std::uint32_t pair = i / 2;
    const double y = (pair - 2.) * 70 + 30 * uniform(seed, i);
    Object hill = standing_at(x, y, 0, hash(seed, 90 + i));
    const double height = 16 + 18 * uniform(seed, 100 + i);
    hill.parts.push_back({ellipsoid({0, 0, -2}, {70, 70, height}), Material::foliage,
                          Vector3f(0.12F, 0.22F, 0.07F)});
    objects.push_back(hill);
  }
}

void place_parked(std::vector<Object>& objects, const StreetSpec& street, const Place& place) {
  Object car = make_vehicle(uniform(place.seed, 5) < 0.85 ? "car" : "van", hash(place.seed, 6));
  car.motion.x = place.x;
  car.motion.y = place.side * (kerb_y(street) - 1.2 + 0.15 * uniform(place.seed, 7));
  car.motion.yaw = (place.side > 0 ? M_PI : 0) + 0.04 * (uniform(place.seed, 8) - 0.5);
  objects.push_back(car);
}

}  // namespace

double kerb_y(const StreetSpec& street) {
  return street.lanes_per_direction * street.lane_width + 2.3;
}

std::vector<Object> build_street(const StreetSpec& street, double x_from, double x_to,
                                 std::uint32_t seed) {
  const Eigen::Vector2d x_range(x_from, x_to);
  const double kerb = kerb_y(street);
  std::vector<Object> objects{make_ground(street)};
  add_buildings(objects, street, x_range, seed);
  add_hills(objects, x_range, seed);
  for (const Place& p : places(street, x_range, 11.7, street.trees, seed + 10)) {
    objects.push_back(make_tree(p.x, p.side * (kerb + 0.9), p.seed));
  }
  for (const Place& p : places(street, x_range, 26.3, street.poles, seed + 20)) {
    objects.push_back(make_lamp(p.x, p.side * (kerb + 0.5), p.side, p.seed));
  }
  for (const Place& p : places(street, x_range, 31.9, street.poles, seed + 30)) {
    objects.push_back(make_sign(p.x, p.side * (kerb + 0.4), p.side > 0 ? M_PI : 0, p.seed));
  }
  for (const Place& p : places(street, x_range, 6.3, street.parked_cars, seed + 40)) {
    place_parked(objects, street, p);
  }
  for (const Place& p : places(street, x_range, 5.1, street.pedestrians, seed + 60)) {
    Object person = make_vehicle("pedestrian", p.seed);
    person.motion.x = p.x;
    person.motion.y = p.side * (kerb + 1.7 + 1.2 * uniform(p.seed, 4));
    person.motion.z = kKerbHeight;
    person.motion.yaw = 2 * M_PI * uniform(p.seed, 5);
    objects.push_back(person);
  }
  return objects;
}

}  // namespace lidar_upsampling::sim
