// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/scene.h"

namespace lidar_upsampling::sim {

/// What of the light is reflected at one place of a surface.
struct Surface {
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();  ///< linear RGB
  float glass = 0;   ///< share of it that is glass, which returns little to a LiDAR
  float mirror = 0;  ///< share that is retro-reflective: plates, signs
};

/// A place on a part's surface and the extent of the filter about it, in the object's frame.
struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  Eigen::Vector3d extent;  ///< of the filter along x, y, z, > 0
  double size = 0;         ///< of the filter, > 0
};

/// @brief The material's texture, rigidly attached to the object, band-limited to the filter:
/// structure (windows, joints, lights, lane marks) by box filters, noise by octaves.
[[nodiscard]] Surface surface_at(const StreetSpec& street, const Object& object, const Part& part,
                                 const SurfacePoint& point);

/// The same for what belongs to vehicles and to the street, in their own files.
[[nodiscard]] Surface vehicle_surface(const Object& object, const Part& part,
                                      const SurfacePoint& point);
[[nodiscard]] Surface ground_surface(const StreetSpec& street, const Object& ground,
                                     const Part& part, const SurfacePoint& point);

[[nodiscard]] inline Eigen::Vector3f blended(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                             float share) {
  return a + (b - a) * share;
}

[[nodiscard]] inline Eigen::Vector3f gray(double value) {
  return Eigen::Vector3f::Constant(static_cast<float>(value));
}

/// Paints `share` of the surface.
inline void put(Surface& surface, const Eigen::Vector3f& color, float share) {
  surface.albedo = blended(surface.albedo, color, share);
}

}  // namespace lidar_upsampling::sim
