// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

/// The neighbourhood of a point on the picture; it must hold the next ring and the next azimuth
/// step on every side. The defaults suit 64 rings over 27 degrees and a focal length of about 700
/// px.
struct Neighbourhood {
  double half_width_px = 4;
  double half_height_px = 7;
};

/// @brief Points that the camera does not see though the LiDAR does, as it looks from elsewhere:
/// those with clearly nearer neighbours on opposite sides. One side alone is no evidence: a ground
/// seen at a grazing angle has nearer neighbours below, too.
/// @return 1 for each hidden point, in the order of `points`.
/// @throw std::invalid_argument a neighbourhood that is not positive.
[[nodiscard]] std::vector<std::uint8_t> mark_occluded(const std::vector<ProjectedPoint>& points,
                                                      const Neighbourhood& neighbourhood = {});

/// @brief Points beside a depth jump, on either side of it: where a neighbourhood deviates from its
/// least-squares plane (inverse depth is affine on the picture of a plane). A picture patch there
/// shows two things that move apart.
/// @return 1 for each such point, in the order of `points`.
/// @throw std::invalid_argument a neighbourhood that is not positive.
[[nodiscard]] std::vector<std::uint8_t> mark_depth_edges(const std::vector<ProjectedPoint>& points,
                                                         const Neighbourhood& neighbourhood = {});

/// What mark_occluded() and mark_depth_edges() tell.
struct Visibility {
  std::vector<std::uint8_t> hidden, on_edge;  ///< of each point
};

/// @brief Both at once, which is faster.
/// @throw std::invalid_argument a neighbourhood that is not positive.
[[nodiscard]] Visibility mark_visibility(const std::vector<ProjectedPoint>& points,
                                         const Neighbourhood& neighbourhood = {});

}  // namespace lidar_upsampling
