// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "densify.h"
#include "lidar_upsampling/ego/time_offset.h"
#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/log_index.h"

namespace lidar_upsampling {

/// What a camera shows of the LiDAR's world.
struct CameraCheck {
  Camera camera;
  std::size_t num_compared = 0;  ///< pictures laid beside the scan next to them
  double share_in_view = 0;      ///< of a scan's points that fall into the picture, mean
  std::optional<TimeOffset> time_offset;
  std::string overlay;  ///< file of a scan's points on a picture; empty: none was asked for
};

/// What a log holds, and whether its sensors fit together.
struct LogCheck {
  LogIndex index;
  std::string ego_source;
  std::string lidar_label;
  Pose T_vehicle_lidar = Pose::Identity();
  std::size_t num_scans = 0;  ///< that were looked at, evenly over the log
  double mean_points = 0;     ///< per scan
  int num_rings = 0;          ///< 0: not told by the log
  bool has_point_times = false;
  bool uses_point_times = false;  ///< to straighten the scan
  double time_offset_in_force_ms = 0;
  std::vector<CameraCheck> cameras;
  UnusedCounts unused;
};

/// @brief Looks through a log before it is densified; nothing is written but `job.pictures`.
/// Without any ego-motion in the log, that between neighbouring scans is measured.
/// @throw std::runtime_error as densify().
[[nodiscard]] LogCheck check_log(const DensifyJob& job,
                                 const std::function<void(double)>& progress);

/// @brief The time offset of the pictures that is to be set in place of the one in force; none:
/// they differ by no more than can be told.
[[nodiscard]] std::optional<double> offset_to_set_ms(const CameraCheck& camera, double in_force_ms);

/// Whether a log can be densified, and what is to be set for it, in a line.
[[nodiscard]] std::string verdict_of(const LogCheck& check);

/// One item per line, for people; the verdict last.
[[nodiscard]] std::string to_text(const LogCheck& check);

}  // namespace lidar_upsampling
