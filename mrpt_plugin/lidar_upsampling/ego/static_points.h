// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

struct StaticPointOptions {
  int max_points = 300;
};

/// What is known of the points of a scan on a picture; the flags are in the order of `points`.
struct StaticPointQuery {
  const std::vector<ProjectedPoint>& points;
  const std::vector<std::uint8_t>& is_unreliable;  ///< occluded, or beside a depth edge
  const std::vector<std::uint8_t>& is_candidate;   ///< of an object that may move
  cv::Size picture;                                ///< pixels
  cv::Mat texture;  ///< CV_32FC1, smaller eigenvalue of the structure tensor
};

/// @brief Points to follow for the camera's ego-motion: spread over the picture by a grid, the best
/// of each cell first (most texture), away from what may move.
/// @return indices into `points`, at most `max_points`.
[[nodiscard]] std::vector<int> choose_static_points(const StaticPointQuery& query,
                                                    const StaticPointOptions& options = {});

}  // namespace lidar_upsampling
