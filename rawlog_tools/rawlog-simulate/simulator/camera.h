// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// A picture whose pixels know what they show.
struct RenderedImage {
  CameraImage image;
  double taken_at = 0;  ///< seconds since the start
  cv::Mat object;  ///< CV_32S: place in World::objects of what a pixel's centre shows, -1: the sky
};

/// @brief Renders the world through one camera, distortion included: one ray per pixel with
/// analytically filtered textures, several where an edge or a shadow's border passes. Pixel (u, v)
/// is the square about the integer coordinates (u, v), as in OpenCV's projection.
class CameraRenderer {
 public:
  explicit CameraRenderer(const CameraSpec& spec);

  /// The same seed and stamp give the same picture on any number of threads.
  [[nodiscard]] RenderedImage render(const World& world, Stamp stamp, std::uint32_t seed) const;

  /// Direction of a picture point (u + 0.5, v + 0.5 from the pixel's corner at (u, v)) with z = 1,
  /// camera frame. Corners run from 0 to width and height.
  [[nodiscard]] const Eigen::Vector2d& corner_ray(int u, int v) const {
    return corner_rays_[static_cast<std::size_t>(v) * (spec_.camera.model.width + 1) + u];
  }
  [[nodiscard]] const CameraSpec& spec() const { return spec_; }

 private:
  CameraSpec spec_;
  std::vector<Eigen::Vector2d> corner_rays_;
};

/// The factor on the light at a time.
[[nodiscard]] double gain_at(const CameraSpec& spec, double t);

}  // namespace lidar_upsampling::sim
