// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lidar_upsampling/robust/ransac.h"

namespace lidar_upsampling {

/// Points p with normal . p + d = 0; the normal has unit length.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double d = 0;

  [[nodiscard]] double signed_distance(const Eigen::Vector3d& point) const {
    return normal.dot(point) + d;
  }
};

struct PlaneOptions {
  double inlier_distance_m = 0.15;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the points' frame
  double max_tilt_deg = 15;                       ///< of the normal from `up`
  int min_inliers = 30;
  int max_scored_points = 4000;  ///< hypotheses are scored on a random choice of this size
  RansacOptions ransac{20, 300, 0.9999, 1};
};

struct PlaneFit {
  Plane plane;          ///< its normal points up
  int num_inliers = 0;  ///< among all points
  double rmse_m = 0;    ///< of the inliers
};

/// @brief The dominant plane, by MSAC (Torr & Zisserman, MLESAC, CVIU 2000, sec. 3) and least
/// squares on its inliers.
/// @param points metres, any frame.
/// @param indices of the points that count.
/// @return none if no plane of that tilt has `min_inliers`.
/// @throw std::invalid_argument options out of range, or an index that lies outside.
[[nodiscard]] std::optional<PlaneFit> estimate_plane(const std::vector<Eigen::Vector3f>& points,
                                                     const std::vector<int>& indices,
                                                     const PlaneOptions& options = {});

}  // namespace lidar_upsampling
