// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>

#include "simulator/noise.h"
#include "simulator/texture.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

const NoiseSpectrum kWeathering{0.8, 7, 0.85};

// Something rectangular on a face seen along x (front, rear) or y (sides).
float patch(const SurfacePoint& p, int axis, const Eigen::Vector2d& across,
            const Eigen::Vector2d& height) {
  const double value = axis == 1 ? std::abs(p.position.y()) : p.position.x();
  return stripe(value, across[0], across[1], p.extent[axis]) *
         stripe(p.position.z(), height[0], height[1], p.extent.z());
}

void put_glass(Surface& surface, float share, const VehicleShape& shape, double z) {
  const double up = (z - shape.belt) / (shape.height - shape.belt);
  put(surface, Vector3f(0.035F, 0.05F, 0.06F) * static_cast<float>(0.6 + 1.5 * up), share);
  surface.glass = std::max(surface.glass, share);
}

void put_plate(Surface& surface, const SurfacePoint& p, double z) {
  const float plate = patch(p, 1, {-1, 0.26}, {z, z + 0.11});
  const float letters = stripes(p.position.y() + 0.3, 0.075, 0.045, p.extent.y()) *
                        patch(p, 1, {-1, 0.22}, {z + 0.02, z + 0.09});
  put(surface, gray(0.8), plate);
  put(surface, gray(0.03), 0.8F * letters);
  surface.mirror = plate;
}

void paint_front(Surface& surface, const VehicleShape& s, const SurfacePoint& p) {
  const double half = 0.5 * s.width, low = s.nose - 0.26, high = s.nose - 0.08;
  put(surface, gray(0.03), patch(p, 1, {-1, 0.5 * half}, {low, high}));
  put(surface, gray(0.22),
      0.8F * patch(p, 1, {-1, 0.48 * half}, {low, high}) *
          stripes(p.position.z(), 0.05, 0.018, p.extent.z()));
  put(surface, gray(0.85), patch(p, 1, {0.56 * half, 0.93 * half}, {low + 0.02, high}));
  put(surface, gray(0.25), patch(p, 1, {0.66 * half, 0.78 * half}, {low + 0.05, high - 0.04}));
  put(surface, gray(0.03), patch(p, 1, {-1, 0.8 * half}, {0, s.clearance + 0.13}));
  put_plate(surface, p, s.clearance + 0.16);
}

void paint_rear(Surface& surface, const VehicleShape& s, const SurfacePoint& p) {
  const double half = 0.5 * s.width, top = s.belt - 0.07;
  put(surface, Vector3f(0.5F, 0.01F, 0.01F), patch(p, 1, {0.66 * half, 2}, {top - 0.24, top}));
  put(surface, Vector3f(0.8F, 0.45F, 0.2F), patch(p, 1, {0.66 * half, 2}, {top - 0.15, top - 0.1}));
  put(surface, gray(0.02), patch(p, 1, {-1, 0.98 * half}, {top - 0.42, top - 0.405}));
  put(surface, gray(0.03), patch(p, 1, {-1, 2}, {0, s.clearance + 0.17}));
  put_plate(surface, p, top - 0.2);
}

void paint_side(Surface& surface, const VehicleShape& s, const SurfacePoint& p) {
  const double low = s.clearance + 0.12;
  for (const auto& window : s.side_windows) {
    for (const double x : {window.first - 0.05, window.second + 0.05}) {
      put(surface, surface.albedo * 0.15F, patch(p, 0, {x - 0.012, x + 0.012}, {low, s.belt}));
    }
    const double handle = window.first + 0.12;
    put(surface, gray(0.04), patch(p, 0, {handle, handle + 0.18}, {s.belt - 0.14, s.belt - 0.1}));
  }
  put(surface, surface.albedo * 0.6F,
      patch(p, 0, {s.rear_axle, s.front_axle}, {s.belt - 0.3, s.belt - 0.27}));
  put(surface, gray(0.03), patch(p, 0, {-9, 9}, {0, low - 0.02}));
  for (const double axle : {s.front_axle, s.rear_axle}) {
    const double distance = std::hypot(p.position.x() - axle, p.position.z() - s.wheel_radius);
    put(surface, gray(0.008), disc(distance, s.wheel_radius + 0.06, p.size));
  }
  put(surface, Vector3f(0.7F, 0.3F, 0.03F),
      patch(p, 0, {s.front_axle + 0.5, s.front_axle + 0.62}, {s.nose - 0.16, s.nose - 0.1}));
}

void paint_body(Surface& surface, const VehicleShape& s, const SurfacePoint& p) {
  if (p.normal.x() > 0.75) {
    paint_front(surface, s, p);
  } else if (p.normal.x() < -0.75) {
    paint_rear(surface, s, p);
  } else if (std::abs(p.normal.y()) > 0.6) {
    paint_side(surface, s, p);
  } else if (p.normal.z() > 0.5) {
    const double y = std::abs(p.position.y());
    put(surface, surface.albedo * 0.4F,
        stripe(y, 0.36 * s.width, 0.36 * s.width + 0.02, p.extent.y()));
  }
}

void paint_cabin(Surface& surface, const VehicleShape& s, const SurfacePoint& p) {
  const Vector3d& q = p.position;
  const double low = s.belt + 0.03, high = s.height - 0.11;
  const double rise = (q.z() - s.belt) / (s.height - s.belt);
  if (std::abs(p.normal.y()) > 0.6) {
    // The slanted pillars end the first and the last window.
    const double front = s.windscreen_foot + rise * (s.windscreen_top - s.windscreen_foot) - 0.14;
    const double rear = s.rear_window_foot + rise * (s.rear_window_top - s.rear_window_foot) + 0.14;
    for (const auto& window : s.side_windows) {
      const float share =
          patch(p, 0, {std::max(rear, window.first), std::min(front, window.second)}, {low, high});
      put_glass(surface, share, s, q.z());
    }
  } else if (std::abs(p.normal.x()) > 0.2 && std::abs(p.normal.y()) < 0.4) {
    const double half = 0.5 * s.width - 0.12 - s.lean * (q.z() - s.belt);
    const bool van_rear = p.normal.x() < 0 && s.side_windows.size() == 1;
    put_glass(surface, patch(p, 1, {van_rear ? 0.04 : -9, half}, {low, high}), s, q.z());
  }
}

void paint_cargo(Surface& surface, const Object& object, const SurfacePoint& p) {
  const double across = std::abs(p.normal.y()) > 0.5 ? p.position.x() : p.position.y();
  const double extent = std::abs(p.normal.y()) > 0.5 ? p.extent.x() : p.extent.y();
  const float rib = stripes(across, 0.4, 0.03, extent);
  put(surface, surface.albedo * 0.5F, rib);
  const auto tint = [&](std::uint32_t i) {
    return static_cast<float>(0.5 * uniform(object.seed, i));
  };
  const float band = stripe(p.position.z(), 1.6, 2.5, p.extent.z());
  put(surface, {tint(1), tint(2), tint(3)}, band);
  const float letters =
      stripes(across, 0.7, 0.42, extent) * stripe(p.position.z(), 1.8, 2.3, p.extent.z());
  put(surface, gray(0.85), letters * (std::abs(across) < 2.4 ? 1.F : 0.F));
}

void paint_wheel(Surface& surface, const VehicleShape& s, const SurfacePoint& p) {
  if (std::abs(p.normal.y()) < 0.5) return;
  const double axle = p.position.x() > 0 ? s.front_axle : s.rear_axle;
  const double dx = p.position.x() - axle, dz = p.position.z() - s.wheel_radius;
  const double distance = std::hypot(dx, dz);
  const double sharpness = std::min(1., 0.06 / p.size);
  const double spokes = 0.5 + 0.5 * std::tanh(4 * std::cos(5 * std::atan2(dz, dx))) * sharpness;
  put(surface, gray(0.07 + 0.45 * spokes), disc(distance, 0.66 * s.wheel_radius, p.size));
  put(surface, gray(0.5), disc(distance, 0.2 * s.wheel_radius, p.size));
}

}  // namespace

Surface vehicle_surface(const Object& object, const Part& part, const SurfacePoint& point) {
  Surface surface;
  surface.albedo = part.color;
  const VehicleShape& shape = object.shape;
  if (part.material == Material::body) paint_body(surface, shape, point);
  if (part.material == Material::cabin) paint_cabin(surface, shape, point);
  if (part.material == Material::cargo) paint_cargo(surface, object, point);
  if (part.material == Material::wheel) paint_wheel(surface, shape, point);
  const float noise =
      object.grain * fractal_noise(point.position, object.seed, kWeathering, point.size);
  const double grime = std::max(0., 1 - (point.position.z() - shape.clearance) / 0.5);
  put(surface, Vector3f(0.16F, 0.13F, 0.10F),
      static_cast<float>(0.45 * grime) * std::max(0.F, 0.5F + 0.7F * noise));
  surface.albedo *= std::max(0.1F, 1 + 0.45F * noise);
  surface.albedo += Vector3f::Constant(0.012F * std::max(-1.F, noise) + 0.012F);
  return surface;
}

}  // namespace lidar_upsampling::sim
