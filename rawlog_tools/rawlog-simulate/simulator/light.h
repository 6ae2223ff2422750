// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>

#include "simulator/scene.h"

namespace lidar_upsampling::sim {

/// The sun stands still in the world; its direction points to it.
[[nodiscard]] Eigen::Vector3d sun_direction();

/// @brief Answers whether the sun reaches a point: every part is filed under the cells of the
/// ground that its shadow may fall on.
class SunShadows {
 public:
  explicit SunShadows(const Scene& scene);

  [[nodiscard]] bool lit(const Eigen::Vector3d& point_in_world,
                         const Eigen::Vector3d& normal) const;

 private:
  void file(int part, const Eigen::AlignedBox2d& shadow);
  [[nodiscard]] bool blocked(const PlacedPart& part, const Eigen::Vector3d& point) const;

  const Scene& scene_;
  Eigen::Vector2d lowest_ = Eigen::Vector2d::Zero();
  std::array<int, 2> num_cells_{};
  std::vector<std::vector<int>> cells_;
};

/// Radiance of the sky in a direction of the world: gradient, clouds, haze at the horizon.
[[nodiscard]] Eigen::Vector3f sky(const AppearanceSpec& appearance,
                                  const Eigen::Vector3d& direction, double size);

/// Light from a surface towards a viewer at a distance: Lambert under sun and sky, seen through
/// haze.
[[nodiscard]] Eigen::Vector3f shaded(const AppearanceSpec& appearance,
                                     const Eigen::Vector3f& albedo, const Eigen::Vector3d& normal,
                                     bool lit, double range);

}  // namespace lidar_upsampling::sim
