// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

/// A correspondence freed of its lens: near the normalised coordinates, pixels are their affine
/// image.
struct Observation {
  Eigen::Vector3d point_in_source;
  Eigen::Vector2d normalised;  ///< (x/z, y/z) of the ray through the pixel
  Eigen::Matrix2d pixel_by_normalised;
  int index;  ///< of the correspondence
};

/// @brief Undistorts once what every hypothesis needs; leaves out pixels the lens model does not
/// hold for.
/// @throw std::invalid_argument camera model out of range, a coordinate that is not finite.
[[nodiscard]] std::vector<Observation> observe(const std::vector<Correspondence>& correspondences,
                                               const CameraModel& model);

/// @brief Scales residuals so that they have `sigma_px` per axis where the patches' texture says
/// less, too: along an edge, or where there is little, a patch slides and stays where it was put.
void weigh_by_texture(std::vector<Observation>& observations,
                      const std::vector<Correspondence>& correspondences, double sigma_px);

/// @brief Squared pixel distance between observation and projection, exact for small ones; infinity
/// behind the camera.
[[nodiscard]] double sq_reprojection_error(const Observation& observation,
                                           const Pose& T_camera_source);

/// A reprojection error in pixels, and its derivative by a left increment (w, t) of the pose.
struct Reprojection {
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, 6> jacobian;
};

/// @return none behind the camera.
[[nodiscard]] std::optional<Reprojection> reprojection(const Observation& observation,
                                                       const Pose& T_camera_source);

}  // namespace lidar_upsampling
