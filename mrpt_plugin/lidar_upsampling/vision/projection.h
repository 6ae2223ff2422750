// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

constexpr double kNearestDepth = 1e-3;  ///< metres; what is nearer counts as behind the camera

/// A point of a scan as it appears on a picture.
struct ProjectedPoint {
  int index;    ///< in the scan
  float u, v;   ///< pixels; (0, 0) is the centre of the top left pixel
  float depth;  ///< metres along the optical axis
};

/// @throw std::invalid_argument if size or focal length are not positive or a parameter is not
/// finite.
void check(const CameraModel& model);

/// @brief The pixel of a point of the camera frame (metres).
/// @param margin_px distance that the pixel keeps from the outermost pixel centres; negative: how
/// far outside it may lie.
/// @return none behind the camera, outside the picture, or where the lens model does not hold.
[[nodiscard]] std::optional<Eigen::Vector2d> project(const CameraModel& model,
                                                     const Eigen::Vector3d& point_in_camera,
                                                     double margin_px = 0);

/// @brief project() for many points: where the lens model holds is found once, which costs as much
/// as a hundred projections. The model must outlive it.
class Projector {
 public:
  explicit Projector(const CameraModel& model);

  [[nodiscard]] std::optional<Eigen::Vector2d> operator()(const Eigen::Vector3d& point_in_camera,
                                                          double margin_px = 0) const;

 private:
  const CameraModel& model_;
  double max_radius_;  ///< normalised
};

/// @brief The normalised coordinates (x/z, y/z) that a pixel sees.
/// @return none where the lens model does not hold.
[[nodiscard]] std::optional<Eigen::Vector2d> undistort(const CameraModel& model,
                                                       const Eigen::Vector2d& pixel);

/// @brief project() for a whole scan.
/// @param points in the lidar frame, metres.
/// @return the points in view, in the order of the scan.
[[nodiscard]] std::vector<ProjectedPoint> project_scan(const CameraModel& model,
                                                       const Pose& T_camera_lidar,
                                                       const std::vector<Eigen::Vector3f>& points,
                                                       double margin_px = 0);

}  // namespace lidar_upsampling
