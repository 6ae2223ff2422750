// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/light.h"

#include <algorithm>
#include <cmath>

#include "simulator/noise.h"
#include "simulator/texture.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kCell = 2;
const Vector3f kSunLight(2.35F, 2.2F, 1.95F), kSkyLight(0.62F, 0.72F, 0.88F);
const Vector3f kHaze(0.70F, 0.79F, 0.90F);

Vector2d along_sun(const Vector3d& p) {
  const Vector3d sun = sun_direction();
  return p.head<2>() - p.z() / sun.z() * sun.head<2>();
}

Eigen::AlignedBox2d shadow_of(const PlacedPart& part) {
  Eigen::AlignedBox2d shadow;
  for (const Vector3d& v : part.vertices) shadow.extend(along_sun(v));
  if (part.vertices.empty()) {
    // The shadow of a ball is stretched along the sun's azimuth only; its longest radius will do.
    const double reach = part.radius / sun_direction().z();
    shadow.extend(along_sun(part.center) - Vector2d::Constant(reach));
    shadow.extend(along_sun(part.center) + Vector2d::Constant(reach));
  }
  return shadow;
}

}  // namespace

Vector3d sun_direction() { return Vector3d(-0.52, -0.36, 0.78).normalized(); }

SunShadows::SunShadows(const Scene& scene) : scene_(scene) {
  Eigen::AlignedBox2d extent;
  for (const PlacedPart& part : scene.parts) {
    if (std::isfinite(part.radius) && part.radius < 30) extent.extend(shadow_of(part));
  }
  if (extent.isEmpty()) return;
  lowest_ = extent.min();
  for (int i = 0; i < 2; ++i) num_cells_[i] = static_cast<int>(extent.sizes()[i] / kCell) + 1;
  cells_.resize(static_cast<std::size_t>(num_cells_[0]) * num_cells_[1]);
  for (std::size_t i = 0; i < scene.parts.size(); ++i) {
    const PlacedPart& part = scene.parts[i];
    if (std::isfinite(part.radius) && part.radius < 30) file(static_cast<int>(i), shadow_of(part));
  }
}

void SunShadows::file(int part, const Eigen::AlignedBox2d& shadow) {
  const Vector2d from = (shadow.min() - lowest_) / kCell, to = (shadow.max() - lowest_) / kCell;
  for (int y = static_cast<int>(from.y()); y <= static_cast<int>(to.y()); ++y) {
    for (int x = static_cast<int>(from.x()); x <= static_cast<int>(to.x()); ++x) {
      cells_[static_cast<std::size_t>(y) * num_cells_[0] + x].push_back(part);
    }
  }
}

bool SunShadows::lit(const Vector3d& point_in_world, const Vector3d& normal) const {
  if (normal.dot(sun_direction()) <= 0) return false;
  const Vector3d start = point_in_world + 1e-3 * normal;
  const Vector2d cell = (along_sun(start) - lowest_) / kCell;
  if (cell.minCoeff() < 0 || cell.x() >= num_cells_[0] || cell.y() >= num_cells_[1]) return true;
  const auto& parts = cells_[static_cast<std::size_t>(cell.y()) * num_cells_[0] +
                             static_cast<std::size_t>(cell.x())];
  return std::none_of(parts.begin(), parts.end(),
                      [&](int i) { return blocked(scene_.parts[i], start); });
}

bool SunShadows::blocked(const PlacedPart& part, const Vector3d& point) const {
  static const Vector3d sun = sun_direction();
  if (part.planes.empty()) {
    const Vector3d o = part.to_unit_ball * (point - part.center), d = part.to_unit_ball * sun;
    const double a = d.squaredNorm(), b = o.dot(d), sq_outside = o.squaredNorm() - 1;
    return b < 0 && sq_outside > 0 && b * b > a * sq_outside;
  }
  double enters = 0, leaves = std::numeric_limits<double>::infinity();
  for (const Plane& plane : part.planes) {
    const double slope = plane.normal.dot(sun), distance = plane.normal.dot(point) - plane.offset;
    if (slope < 0) {
      enters = std::max(enters, -distance / slope);
    } else if (distance > 0) {
      return false;
    } else if (slope > 0) {
      leaves = std::min(leaves, -distance / slope);
    }
    if (enters >= leaves) return false;
  }
  return true;
}

Vector3f sky(const AppearanceSpec& appearance, const Vector3d& direction, double size) {
  const double up = std::max(0., direction.z());
  const Vector3f zenith(0.16F, 0.36F, 0.78F);
  Vector3f color = blended(kHaze, zenith, static_cast<float>(1 - std::exp(-4.5 * up)));
  // Clouds lie on a plane high above, and thin out towards the horizon.
  const double flat = 1 / (up + 0.12);
  const Vector3d on_plane(direction.x() * flat, direction.y() * flat, 0.3);
  const float noise =
      fractal_noise(on_plane, 11, {1.1, 6, 0.62}, std::max(1e-3, size * flat * flat * 0.3));
  const auto cover =
      std::clamp(1.5F * noise - 0.1F, 0.F, 1.F) * static_cast<float>(std::min(1., 5 * up));
  color = blended(color, Vector3f(1.02F, 1.02F, 1.02F), 0.75F * cover);
  return static_cast<float>(appearance.sky) * color;
}

Vector3f shaded(const AppearanceSpec& appearance, const Vector3f& albedo, const Vector3d& normal,
                bool lit, double range) {
  const auto facing = static_cast<float>(std::max(0., normal.dot(sun_direction())));
  const auto open = static_cast<float>(0.62 + 0.38 * normal.z());
  const auto sun = static_cast<float>(appearance.sun), day = static_cast<float>(appearance.sky);
  const Vector3f light = day * open * kSkyLight + (lit ? sun : 0.F) * facing * kSunLight;
  const Vector3f color = albedo.cwiseProduct(light) * 0.5F;
  const auto veil = static_cast<float>(1 - std::exp(-range / 420));
  return blended(color, Vector3f(day * kHaze), veil);
}

}  // namespace lidar_upsampling::sim
