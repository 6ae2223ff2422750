// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <vector>

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// How the instants of a scan's points are known. `as_told` (in settings `auto`): as `points` where
/// the log tells different instants of a scan's points, else as `none`. `none`: all are measured at
/// the stamp, or the scan is corrected already (as KITTI's are). `azimuth`: the scanner turns at a
/// constant rate. `points`: the log tells, point by point.
enum class ScanTime { as_told, none, azimuth, points };

enum class TurnDirection { clockwise, counterclockwise };  ///< seen from above

/// The turn of a spinning scanner; the defaults are KITTI's: from the rear, clockwise, the stamp
/// being the instant at which it faces forward.
struct SweepOptions {
  ScanTime scan_time = ScanTime::as_told;
  double start_deg = 180;  ///< azimuth where a scan begins: lidar frame, 0 ahead, 90 to the left
  TurnDirection direction = TurnDirection::clockwise;
  double reference = 0.5;  ///< share of the turn at the stamp: 0 the begin, 1 the end
  double period_ms = 0;    ///< of one turn; 0: the shortest time between two scans
};

/// @brief With `points`, and with `as_told` where most points have one, leaves out points whose own
/// time is not finite, or further than a second from the stamp: what was not measured is often
/// zero, or anything. @return how many.
std::size_t drop_points_without_time(LidarScan& scan, const SweepOptions& options);

/// @brief When each point was measured, in seconds from the scan's stamp.
/// @param period_s of one turn, for `azimuth`; 0: not known yet, so nothing is; nor of more than a
/// second, between which scans are missing.
/// @return none for ScanTime::none, nor for `as_told` without such; else one per point.
/// @throw std::runtime_error `points`, but the scan has no times, or one further than a second from
/// its stamp.
[[nodiscard]] std::vector<float> point_times(const LidarScan& scan, const SweepOptions& options,
                                             double period_s);

/// @brief Of one turn, s: as the options tell, or the shortest time between two scans.
/// @param at_most that long, s; 0: nothing is known of it.
/// @return 0: not known.
[[nodiscard]] double turn_s(const SweepOptions& options, const std::vector<Stamp>& scans,
                            double at_most = 0);

/// T_lidar_k_lidar: where the lidar was this many seconds after the scan's stamp.
using LidarPath = std::function<Pose(double)>;

/// @brief Brings points that do not move to the scan's stamp: what was measured under way as if
/// from where the lidar was at the stamp. What moves on its own stays where it was at its own
/// instant, told by `time_s`, which is set to `times`.
/// @param times of each point, seconds from the stamp; empty: nothing is done.
/// @param path taken every 2 ms, straight in between.
void deskew(LidarScan& scan, const std::vector<float>& times, const LidarPath& path);

}  // namespace lidar_upsampling
