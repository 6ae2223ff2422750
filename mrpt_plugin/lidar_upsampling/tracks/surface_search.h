// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "lidar_upsampling/tracks/track_state.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/klt.h"

namespace lidar_upsampling {

/// A rigid surface on one picture, of which it is not known where it is on another.
struct LostSurface {
  const ImagePyramid &from, &to;
  const CameraModel& camera;
  Pose T_camera_source;                 ///< of the second picture; source: the points' frame
  std::vector<Eigen::Vector3d> points;  ///< m, source frame, where they were on the first picture
  std::vector<cv::Point2f> from_px;     ///< of each, on the first picture
};

/// @brief The motion by which all points together look most like the first picture: tried on a grid
/// over what is expected, on small pictures first. A single point's neighbourhood looks alike at
/// many places, a whole surface hardly.
/// @param expected of their middle and heading, source frame.
/// @return T_mov, source frame, good to some pixels; none where what is expected is narrower than
/// the patches that are searched for one by one, or where nothing looks like it.
[[nodiscard]] std::optional<Pose> search_surface(const LostSurface& lost,
                                                 const PlanarStep& expected,
                                                 const KltOptions& options);

}  // namespace lidar_upsampling
