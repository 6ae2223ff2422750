// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/registration/surface.h"

namespace lidar_upsampling {

/// @brief Which way an object's faces look, level: by the normals of its surface and, where one
/// ring alone shows a face, by the line that this is from above. Of what is no face, or a single
/// column of beams, it is not known.
class Faces {
 public:
  explicit Faces(const Surface& surface);

  /// @brief The share of the surface that is known to lie across a direction, within 60 degrees;
  /// the rest lies along it, or may.
  /// @param d unit vector, level, lidar frame.
  [[nodiscard]] double share_across(const Eigen::Vector2d& d) const;

 private:
  std::vector<Eigen::Vector2f> normals_;  // level part; zero where it is not known
};

}  // namespace lidar_upsampling
