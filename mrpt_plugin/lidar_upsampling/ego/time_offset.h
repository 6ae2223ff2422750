// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// How a camera's clock is compared with the LiDAR's.
struct TimeOffsetOptions {
  double max_offset_s = 0.05;  ///< searched to either side
  double step_s = 0.001;
  double min_range_m = 3, max_range_m = 40;
  double min_jump_m = 0.5;  ///< to the next beam, from the nearer point on, plus
  double min_jump_per_range = 0.05;
  double max_moved_m = 0.05;  ///< of an edge since the scan before, plus a beam's step
  double blur_px = 1.2;       ///< of the picture, sigma
  double min_shift_px = 3;    ///< over the search, of the middle edge; less tells nothing
  int min_edges = 20;         ///< of a scan on a picture
  int min_pictures = 8;
  /// What the calibration may be wrong along the way: at one speed no log can tell it from time.
  double calibration_sigma_m = 0.02;
  double max_sigma_s = 0.006;  ///< less certain is not told
};

/// A real scan and a picture of about its time.
struct ScanOnPicture {
  const LidarScan& scan;  ///< referred to one instant; with rings and columns it is told better
  const CameraImage& image;
  /// T_lidar_t_lidar_k: the ego-motion from the scan's stamp on, by seconds.
  std::function<Pose(double)> lidar_step;
  /// The scan before, where there is one: edges that were elsewhere then move on their own.
  const LidarScan* before = nullptr;
};

struct OffsetScores {
  std::vector<double> score;  ///< per candidate offset, from -max_offset_s to max_offset_s
  double speed = 0;           ///< m/s, of the lidar
};

/// @brief How well the scan's depth edges lie on the picture's edges if the picture was taken at
/// its stamp less an offset (after Levinson and Thrun, RSS 2013, who look for a pose that way).
/// @return none: too few edges, or a vehicle too slow for an offset to shift them.
/// @throw std::invalid_argument camera model out of range.
[[nodiscard]] std::optional<OffsetScores> score_time_offsets(const ScanOnPicture& pair,
                                                             const TimeOffsetOptions& options = {});

struct TimeOffset {
  double offset_s = 0;  ///< pictures are taken this long before their stamps
  double sigma_s = 0;   ///< scatter between parts of the log, and what the calibration may be wrong
  int num_pictures = 0;
};

/// @brief The offset that suits all pictures best.
/// @param scores by these options.
/// @return none where it cannot be told: too few pictures, no peak within the search, or one that
/// is not certain to `max_sigma_s`.
[[nodiscard]] std::optional<TimeOffset> estimate_time_offset(
    const std::vector<OffsetScores>& scores, const TimeOffsetOptions& options = {});

}  // namespace lidar_upsampling
