// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace lidar_upsampling {

/// Points p with normal . p + d = 0; the normal has unit length.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double d = 0;
};

struct PlaneOptions {
  double inlier_distance_m = 0.15;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the points' frame
  double max_tilt_deg = 15;                       ///< of the normal from `up`
  int min_inliers = 30;
};

/// @brief The dominant plane, by MSAC (Torr & Zisserman, MLESAC, CVIU 2000, sec. 3) and least
/// squares on its inliers.
/// @param points metres, any frame.
/// @return its normal points up; none if no plane of that tilt has `min_inliers`.
/// @throw std::invalid_argument options out of range.
[[nodiscard]] std::optional<Plane> estimate_plane(const std::vector<Eigen::Vector3f>& points,
                                                  const PlaneOptions& options = {});

}  // namespace lidar_upsampling
