// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/texture.h"

#include <cmath>

#include "simulator/noise.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kGroundFloor = 4.1, kFloor = 3.1, kBay = 2.4;

// A window's own look (curtains, blinds, lights), fading where windows are as small as the filter.
Vector3f pane(std::uint32_t seed, int bay, int floor, double up, double size) {
  const auto own = static_cast<float>(uniform(seed + 31 * bay, static_cast<std::uint32_t>(floor)));
  const auto fade = static_cast<float>(std::clamp(1.5 - size / (0.5 * kBay), 0., 1.));
  const float light = 0.06F + fade * (own > 0.75F ? 0.22F : 0.08F * (own - 0.4F));
  return Vector3f(0.85F, 1.F, 1.15F) * (light * static_cast<float>(0.7 + 0.6 * up));
}

void put_windows(Surface& surface, std::uint32_t seed, const SurfacePoint& p, int axis) {
  const double h = p.position[axis] + 100 * kBay, z = p.position.z() - kGroundFloor;
  const int bay = static_cast<int>(std::floor(h / kBay)),
            floor = static_cast<int>(std::floor(z / kFloor));
  const double u = h - bay * kBay, v = z - floor * kFloor, du = p.extent[axis], dv = p.extent.z();
  const auto rectangle = [&](double u0, double u1, double v0, double v1) {
    return stripes(h - u0, kBay, u1 - u0, du) * stripes(z - v0, kFloor, v1 - v0, dv);
  };
  put(surface, surface.albedo * 1.25F, rectangle(0.5, 1.9, 0.72, 2.58));
  put(surface, gray(0.7), rectangle(0.6, 1.8, 0.85, 2.5));
  const float glass = rectangle(0.68, 1.17, 0.93, 2.42) + rectangle(1.23, 1.72, 0.93, 2.42);
  put(surface, pane(seed, bay, floor, (v - 0.9) / 1.5, p.size), std::min(1.F, glass));
  put(surface, surface.albedo * 0.5F, rectangle(0.45, 1.95, 0.64, 0.72));
  surface.glass = std::min(1.F, glass);
  if (u < 0 || v < 0) surface.glass = 0;
}

void put_shops(Surface& surface, std::uint32_t seed, const SurfacePoint& p, int axis) {
  const double h = p.position[axis] + 100 * kBay, z = p.position.z();
  const double period = 2 * kBay, du = p.extent[axis], dv = p.extent.z();
  const auto bay = static_cast<std::uint32_t>(std::floor(h / period));
  const auto tint = [&](std::uint32_t i) {
    return static_cast<float>(0.04 + 0.4 * uniform(seed + bay, i));
  };
  put(surface, surface.albedo * 0.55F, stripe(z, -1, 0.55, dv));
  const float window = stripes(h - 0.4, period, 2.7, du) * stripe(z, 0.6, 2.6, dv);
  const float door = stripes(h - 3.5, period, 1, du) * stripe(z, 0.12, 2.5, dv);
  put(surface, gray(0.10), window);
  const float glass = stripes(h - 0.5, period, 2.5, du) * stripe(z, 0.7, 2.5, dv);
  put(surface, pane(seed, static_cast<int>(bay), 77, z / 3, p.size), glass);
  const float goods = stripes(h - 0.5, 0.42, 0.22, du) * stripe(z, 0.75, 1.35, dv) * glass;
  put(surface, {tint(1), tint(2), tint(3)}, 0.7F * goods);
  put(surface, {tint(4), tint(5) * 0.6F, tint(6) * 0.5F}, door);
  const float board = stripes(h - 0.3, period, 4.2, du) * stripe(z, 3.3, 3.85, dv);
  put(surface, {tint(7), tint(8), tint(9)}, board);
  put(surface, gray(0.75),
      0.9F * stripes(h - 0.9, 0.34, 0.2, du) * stripe(z, 3.42, 3.72, dv) *
          stripes(h - 0.9, period, 2.7, du));
  surface.glass = std::max(surface.glass, glass);
}

void paint_facade(Surface& surface, const Object& building, const SurfacePoint& p) {
  const int axis = std::abs(p.normal.y()) > 0.5 ? 0 : 1;
  const bool bricks = building.seed % 3 == 0;
  if (bricks) {
    const float joints = stripes(p.position.z(), 0.16, 0.025, p.extent.z()) +
                         stripes(p.position[axis], 0.42, 0.03, p.extent[axis]);
    put(surface, surface.albedo * 1.5F, 0.5F * std::min(1.F, joints));
  }
  const bool upstairs = p.position.z() > kGroundFloor;
  if (upstairs) {
    put_windows(surface, building.seed, p, axis);
  } else {
    put_shops(surface, building.seed, p, axis);
  }
  put(surface, gray(0.45),
      stripe(p.position.z(), kGroundFloor - 0.15, kGroundFloor + 0.05, p.extent.z()));
}

void paint_sign(Surface& surface, const SurfacePoint& p) {
  const double y = p.position.y(), z = p.position.z() - 2.55;
  if (p.normal.x() > -0.5) {
    surface.albedo = gray(0.3);
    return;
  }
  const float inner = disc(std::hypot(y, z), 0.23, p.size);
  put(surface, gray(0.85), inner);
  put(surface, gray(0.03),
      inner * stripe(y, -0.05, 0.05, p.extent.y()) * stripe(z, -0.15, 0.15, p.extent.z()));
  surface.mirror = 1;
}

float roughness(Material material) {
  switch (material) {
    case Material::foliage:
      return 1.1F;
    case Material::bark:
      return 0.5F;
    case Material::cloth:
      return 0.35F;
    default:
      return 0.3F;
  }
}

NoiseSpectrum spectrum(Material material) {
  switch (material) {
    case Material::foliage:
      return {0.5, 6, 1.1};
    case Material::facade:
      return {1.2, 7, 0.9};
    case Material::bark:
      return {0.3, 5, 0.9};
    default:
      return {0.8, 7, 0.85};
  }
}

}  // namespace

Surface surface_at(const StreetSpec& street, const Object& object, const Part& part,
                   const SurfacePoint& p) {
  switch (part.material) {
    case Material::asphalt:
    case Material::pavement:
      return ground_surface(street, object, part, p);
    case Material::body:
    case Material::cabin:
    case Material::cargo:
    case Material::wheel:
      return vehicle_surface(object, part, p);
    default:
      break;
  }
  Surface surface;
  surface.albedo = part.color;
  if (part.material == Material::facade) paint_facade(surface, object, p);
  if (part.material == Material::sign) paint_sign(surface, p);
  if (part.material == Material::awning) {
    put(surface, gray(0.75), stripes(p.position.x(), 0.6, 0.3, p.extent.x()));
  }
  if (part.material == Material::roof) {
    put(surface, surface.albedo * 0.6F, stripes(p.position.y(), 0.32, 0.06, p.extent.y()));
  }
  // What hills are grown with is as coarse as they are large.
  const double scale = part.solid.bounding_radius > 30 ? 12 : 1;
  const float noise = object.grain * fractal_noise(p.position / scale, object.seed,
                                                   spectrum(part.material), p.size / scale);
  surface.albedo *= std::max(0.15F, 1 + roughness(part.material) * noise);
  return surface;
}

Surface ground_surface(const StreetSpec& street, const Object& ground, const Part& part,
                       const SurfacePoint& p) {
  Surface surface;
  surface.albedo = part.color;
  const double x = p.position.x(), y = std::abs(p.position.y()), dx = p.extent.x(),
               dy = p.extent.y();
  const float noise = ground.grain * fractal_noise(p.position, 5, {0.9, 7, 0.95}, p.size);
  const double kerb = kerb_y(street);
  if (part.material == Material::pavement) {
    const float joints = stripes(x, 0.8, 0.02, dx) + stripes(p.position.y(), 0.6, 0.02, dy);
    put(surface, surface.albedo * 0.45F, std::min(1.F, joints));
    put(surface, gray(0.5), stripe(y, kerb - 0.1, kerb + 0.18, dy));
    surface.albedo *= 1 + 0.16F * noise;
    return surface;
  }
  surface.albedo *= 1 + 0.42F * noise;
  // Not within the crossing (the difference to a NaN is never less than anything).
  const bool crossing = std::abs(x - street.crossing_x) < kCrossingHalfWidth + 4.2;
  const double edge = street.lanes_per_direction * street.lane_width;
  float marks = 0;
  if (!crossing && y < kerb) {
    marks = stripe(y, 0.08, 0.2, dy) + stripe(y, edge - 0.06, edge + 0.06, dy);
    for (int lane = 1; lane < street.lanes_per_direction; ++lane) {
      const double line = lane * street.lane_width;
      marks += stripe(y, line - 0.07, line + 0.07, dy) * stripes(x, 9, 3.5, dx);
    }
    marks += stripe(y, edge, kerb, dy) * stripes(x + 3.15, 6.3, 0.1, dx);
  } else if (crossing && y < edge + 2) {
    const double from_center = std::abs(x - street.crossing_x);
    marks = stripe(from_center, kCrossingHalfWidth + 0.7, kCrossingHalfWidth + 3.7, dx) *
            stripes(p.position.y(), 1.1, 0.55, dy);
  }
  const float worn = std::min(1.F, 0.82F + 0.25F * noise);
  put(surface, gray(0.62), std::min(1.F, marks) * worn);
  surface.mirror = 0.3F * std::min(1.F, marks);
  return surface;
}

}  // namespace lidar_upsampling::sim
