// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/types.h"

/// Normalised coordinates are (x/z, y/z) of a camera-frame point; distorted ones are what the lens
/// makes of them, still before focal length and principal point.
namespace lidar_upsampling {

/// A distorted point and its derivative by the undistorted one.
struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

/// Plumb bob: Brown's model with OpenCV's rational denominator; Kannala-Brandt (PAMI 2006): their
/// radially symmetric polynomial of the angle.
[[nodiscard]] Distorted distort(const CameraModel& model, const Eigen::Vector2d& normalised);

/// @brief The largest normalised radius up to which the model is one to one. Beyond it the
/// polynomials fold back, and points far outside the view would land in the picture.
/// @return infinity if the model never folds.
[[nodiscard]] double valid_radius(const CameraModel& model);

/// @brief The inverse of distort(), by Newton's method.
/// @return none if no point within `max_radius` (see valid_radius()) is distorted to there.
[[nodiscard]] std::optional<Eigen::Vector2d> undistort_normalised(const CameraModel& model,
                                                                  const Eigen::Vector2d& distorted,
                                                                  double max_radius);

}  // namespace lidar_upsampling
