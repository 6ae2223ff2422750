// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/fragment.h"

#include <algorithm>
#include <cmath>

#include "simulator/noise.h"
#include "simulator/texture.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3f filtered_albedo(const CameraView& now, const RayHit& hit, const PixelRay& ray) {
  const Object& object = now.world.objects[hit.object];
  const Part& part = object.parts[hit.part];
  const Pose& T_world_object = now.scene.T_world_object[hit.object];
  const Eigen::Matrix3d R = T_world_object.linear().transpose();
  const Vector3d at = R * (now.T_world_camera.translation() + hit.range * ray.direction -
                           T_world_object.translation());
  const double slope = std::min(-0.02, hit.normal.dot(ray.direction));
  const auto on_surface = [&](const Vector3d& change) {
    return Vector3d(R * (hit.range * (change - ray.direction * (hit.normal.dot(change) / slope))));
  };
  Vector3d major = on_surface(ray.du), minor = on_surface(ray.dv);
  if (major.squaredNorm() < minor.squaredNorm()) std::swap(major, minor);
  // A long filter (the road far ahead) is several shorter ones side by side.
  const double ratio = major.norm() / minor.norm();
  const int num_taps = std::clamp(static_cast<int>(ratio), 1, 4);
  major /= num_taps;
  SurfacePoint point;
  point.normal = R * hit.normal;
  point.size = std::max(major.norm(), minor.norm());
  point.extent = (major.array().square() + minor.array().square()).sqrt().max(1e-4);
  Vector3f sum = Vector3f::Zero();
  for (int i = 0; i < num_taps; ++i) {
    point.position = at + (i - 0.5 * (num_taps - 1)) * major;
    sum += surface_at(now.world.street, object, part, point).albedo;
  }
  return sum / static_cast<float>(num_taps);
}

}  // namespace

Fragment trace(const CameraView& now, const PixelRay& ray, const std::vector<int>& candidates) {
  const RayHit hit = now.view.cast(ray.direction, candidates);
  if (!hit.any()) return {sky(now.world.appearance, ray.direction, ray.dv.norm()), 0, -1};
  const Vector3d point = now.T_world_camera.translation() + hit.range * ray.direction;
  const bool lit = now.world.appearance.sun > 0 && now.shadows.lit(point, hit.normal);
  Fragment fragment;
  fragment.object = hit.object;
  fragment.surface = hash(hash(hit.object, hit.part), 2 * (hit.face + 1) + (lit ? 1 : 0)) | 1U;
  fragment.color =
      shaded(now.world.appearance, filtered_albedo(now, hit, ray), hit.normal, lit, hit.range);
  return fragment;
}

}  // namespace lidar_upsampling::sim
