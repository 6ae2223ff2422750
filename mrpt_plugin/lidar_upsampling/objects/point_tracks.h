// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/absolute_pose.h"
#include "lidar_upsampling/vision/klt.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

struct PointTrackOptions {
  int max_points_per_object = 100;
  int border_px = 8;        ///< nearer to the picture's border no point is taken
  bool own_surface = true;  ///< patches are compared where they show their object; off: the paper
};

/// The static scene as an owner of points.
inline constexpr int kStaticOwner = -1;

/// @brief Points of the key scan put on the anchor image, and where they have gone since. One KLT
/// call follows those of all objects, so that the pyramids are shared.
struct PointTracks {
  std::vector<Eigen::Vector3d> point;       ///< of each, lidar frame at k
  std::vector<int> owner;                   ///< the object candidate, or kStaticOwner
  std::vector<cv::Point2f> anchor_px;       ///< where it was put
  std::vector<cv::Point2f> last_px;         ///< where it was last found
  std::vector<std::uint8_t> found;          ///< on the last image
  std::vector<float> residual;              ///< there, gray levels
  std::vector<Eigen::Matrix2f> covariance;  ///< of last_px, px^2, by its texture
  std::vector<PatchReference> reference;    ///< on the anchor, as far as it was looked for yet
  SurfaceMap surfaces;                      ///< of the anchor, by owner; empty: not known

  [[nodiscard]] std::size_t size() const { return point.size(); }
};

/// @brief Chooses up to `max_count` of the candidates, spread over the picture: the best-textured
/// one of each cell of a grid over their bounding box.
/// @param texture the smallest eigenvalue of the gradient matrix at each pixel (CV_32F).
/// @return positions in `candidates`, in order.
[[nodiscard]] std::vector<int> choose_spread(const std::vector<ProjectedPoint>& candidates,
                                             const cv::Mat& texture, int max_count, int border_px);

/// @brief Adds points at their projections on the anchor image.
void add_points(PointTracks& tracks, const std::vector<ProjectedPoint>& projected,
                const std::vector<int>& chosen, const LidarScan& key_scan, int owner);

/// The surfaces that some of the points belong to.
[[nodiscard]] PointLabels labels_of(const PointTracks& tracks,
                                    const std::vector<std::size_t>& which);

/// The found points of one owner.
[[nodiscard]] std::vector<Correspondence> correspondences_of(const PointTracks& tracks, int owner);

}  // namespace lidar_upsampling
