// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/light.h"
#include "simulator/scene.h"

namespace lidar_upsampling::sim {

/// A ray (unit length, world frame) and how it changes over the filter: a pixel or a part of one.
struct PixelRay {
  Eigen::Vector3d direction, du, dv;
};

/// What one ray sees.
struct Fragment {
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  ///< linear RGB
  std::uint32_t surface = 0;  ///< differs between any two surfaces, and between sun and shadow
  int object = -1;            ///< -1: the sky
};

/// The world as a camera sees it at one instant.
struct CameraView {
  const World& world;
  const Scene& scene;
  Pose T_world_camera;
  View view;
  SunShadows shadows;
};

/// @param candidates of `CameraView::view`, for a bundle that holds the ray.
[[nodiscard]] Fragment trace(const CameraView& now, const PixelRay& ray,
                             const std::vector<int>& candidates);

}  // namespace lidar_upsampling::sim
