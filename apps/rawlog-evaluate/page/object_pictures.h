// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

using Positions = std::vector<Eigen::Vector3d>;

/// @brief The part of a picture around an object, with its points where an estimate and where the
/// reference put them.
/// @param estimated, reference lidar frame at the picture; on the picture in their rows' colours.
/// @return none: the object is not on the picture.
[[nodiscard]] std::optional<cv::Mat> draw_on_crop(const CameraImage& image,
                                                  const Pose& T_vehicle_lidar,
                                                  const Positions& estimated,
                                                  const Positions& reference);

/// A square piece of ground, x forward up.
struct Window {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double size_m = 0;
};

/// The window that holds all these points with some room around them.
[[nodiscard]] Window window_around(const std::vector<const Positions*>& points);

/// @brief Points from above over the surrounding scan, on a grid of metres.
/// @param color "#rrggbb" of the points.
[[nodiscard]] cv::Mat draw_from_above(const Window& window, const Positions& surroundings,
                                      const Positions& points, const std::string& color);

/// Pictures as addresses that need no file: photographs, drawings.
[[nodiscard]] std::string jpeg_uri(const cv::Mat& picture);
[[nodiscard]] std::string png_uri(const cv::Mat& picture);

}  // namespace lidar_upsampling
