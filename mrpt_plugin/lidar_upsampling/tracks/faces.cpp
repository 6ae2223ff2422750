// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/faces.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

Faces::Faces(const Surface& surface) {
  constexpr std::size_t kMost = 100;  // the share's deviation is 5 % at worst
  const std::size_t size = surface.points().size(), count = std::min(size, kMost);
  for (std::size_t i = 0; i < count; ++i)
    normals_.emplace_back(surface.normal(static_cast<int>(i * size / count)).head<2>());
}

double Faces::share_across(const Eigen::Vector2d& d) const {
  constexpr float kAcross = 0.5F;  // a normal within 60 degrees
  const auto lies_across = [&](const Eigen::Vector2f& normal) {
    return std::abs(normal.dot(d.cast<float>())) > kAcross;
  };
  return std::count_if(normals_.begin(), normals_.end(), lies_across) /
         static_cast<double>(normals_.size());
}

}  // namespace lidar_upsampling
