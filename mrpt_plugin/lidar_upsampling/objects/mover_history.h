// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// An object that was found to move.
struct Mover {
  std::string class_name;
  std::vector<Eigen::Vector3f> points;  ///< lidar frame at its scan, evenly thinned
  KnownMotion motion;                   ///< in the history's frame at rest
};

struct MoversOfScan {
  Stamp stamp;
  Pose T_rest_lidar = Pose::Identity();
  std::vector<Mover> movers;
};

/// What a run over a log has found to move, scan by scan in time order, for another run over the
/// same log: that one knows who will move before it shows.
using MoverHistory = std::vector<MoversOfScan>;

/// Thinned to what tells the place of an object.
[[nodiscard]] Mover make_mover(std::string class_name, const std::vector<Eigen::Vector3f>& points,
                               const KnownMotion& motion);

/// A mover where it must have been at the scan at hand.
struct ExpectedMover {
  std::string class_name;
  std::vector<Eigen::Vector3f> points;  ///< lidar frame at the scan
  KnownMotion motion;                   ///< of the scan's instant; in the caller's frame at rest
  double sigma_m = 0;                   ///< of its place
  bool is_shown = false;                ///< whether the run has seen it move at the scan, too
};

/// @brief Movers of the scans that follow within half a second, where they must have been at
/// `stamp`: those that a further scan shows to go on as they are said to. Of several sights of one
/// object, the next one.
/// @param R_rest_lidar_k to the caller's frame at rest.
/// @return none for a scan that the history does not hold.
[[nodiscard]] std::vector<ExpectedMover> movers_of_later_scans(
    const MoverHistory& history, Stamp stamp, const Eigen::Matrix3d& R_rest_lidar_k,
    const MotionPriorOptions& options);

/// @brief The scan's points that lie where the mover must have been, the ground left out.
/// @param is_ground of each point; empty: none is.
/// @return indices, ascending.
[[nodiscard]] std::vector<int> points_of_mover(const ExpectedMover& mover, const LidarScan& scan,
                                               const std::vector<std::uint8_t>& is_ground);

}  // namespace lidar_upsampling
