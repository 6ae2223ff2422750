// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/opengl/COpenGLScene.h>

#include <memory>

namespace lidar_upsampling {

/// How many objects of a class are in a scene.
template <typename Object>
[[nodiscard]] std::size_t count(const mrpt::opengl::COpenGLScene& scene) {
  std::size_t number = 0;
  scene.visitAllObjects([&](const mrpt::opengl::CRenderizable::Ptr& object) {
    if (std::dynamic_pointer_cast<Object>(object)) ++number;
  });
  return number;
}

}  // namespace lidar_upsampling
