// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/tracks/hypotheses.h"

/// What all points of an object have wrong alike, as a motion of it; covariances, lidar frame at k.
namespace lidar_upsampling {

/// The ego-motion's error.
[[nodiscard]] Matrix6d ego_error(const MotionQuestion& question);

/// @brief Of the picture: calibration, straightening of the scan, a body that bends. A shift, and
/// from its middle to its edge 0.6 of what its points scatter, which looks like a turn, or like
/// coming nearer. (What stands does so by 0.2 to 0.4 of its scatter, on KITTI and simulated; with
/// 0.6 the motions of KITTI's movers err less than with 0.5.)
/// @param sigma_px scatter of the points, per axis.
[[nodiscard]] Matrix6d picture_error(const MotionQuestion& question, const ImageFactor& image,
                                     double sigma_px, const TrackOptions& options);

}  // namespace lidar_upsampling
