// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/patch_alignment.h"
#include "lidar_upsampling/vision/visibility.h"

namespace lidar_upsampling {

/// The key scan on the picture where its points are first put (the anchor), each point with what
/// speaks against following it.
struct AnchoredScan {
  std::vector<ProjectedPoint> points;
  std::vector<std::uint8_t> hidden, on_edge;  ///< of each of `points`
  std::vector<int> position;                  ///< of each point of the scan, in `points`, or -1
  Neighbourhood sampling;                     ///< of the scan on the picture
};

/// @brief Half the distance to the next ring and azimuth step on the picture, with some room, and
/// most of what a patch reaches.
[[nodiscard]] Neighbourhood sampling_of(const LidarScan& scan, const CameraModel& camera);

/// @brief Projects the scan and marks points behind nearer ones and on depth edges, at the
/// resolution of the scan's own rings and columns.
/// @param T_camera_lidar_a lidar frame at k to the camera at the anchor, the ego-motion included.
[[nodiscard]] AnchoredScan anchor_scan(const LidarScan& scan, const CameraModel& camera,
                                       const Pose& T_camera_lidar_a);

[[nodiscard]] std::vector<ProjectedPoint> visible_points(const AnchoredScan& anchored);

/// @brief The object's visible points, those on depth edges only if there are too few others.
/// @param object indices into the scan.
[[nodiscard]] std::vector<ProjectedPoint> followable_points(const AnchoredScan& anchored,
                                                            const std::vector<int>& object,
                                                            int min_points);

/// @brief Moves the points to where a moving object was at the anchor's instant, which is not the
/// scan's; points that leave the picture are dropped.
[[nodiscard]] std::vector<ProjectedPoint> reprojected(const std::vector<ProjectedPoint>& points,
                                                      const LidarScan& scan,
                                                      const CameraModel& camera,
                                                      const Pose& T_camera_a_lidar_k);

/// @brief Which surface each pixel shows: that of the nearest point whose place it may be, a ring
/// and an azimuth step around it. It is told as far from the objects' points as a patch reaches.
/// @param objects points of each on the picture, where they are at the anchor; their positions are
/// the labels. All others are of one more surface.
[[nodiscard]] SurfaceMap surfaces_on(const AnchoredScan& anchored,
                                     const std::vector<std::vector<ProjectedPoint>>& objects,
                                     const cv::Size& size);

}  // namespace lidar_upsampling
