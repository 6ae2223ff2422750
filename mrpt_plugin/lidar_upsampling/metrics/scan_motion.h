// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Where a key scan's points went in a virtual scan made from it, by ring and column.
/// @return per point of the key scan, an index into the virtual scan or -1. Cells that hold several
/// points are left out. Empty if a scan lacks rings or columns, or if most points are others than
/// the key scan's: drawn anew on the sensor's beams, or a scan of the sensor's own.
[[nodiscard]] std::vector<int> match_by_beam(const LidarScan& key, const LidarScan& virtual_scan);

/// @brief The same for scans without rings or columns: a virtual scan that left nothing out has its
/// points in the key scan's order. Empty if the numbers differ or most points are others.
[[nodiscard]] std::vector<int> match_in_order(const LidarScan& key, const LidarScan& virtual_scan);

/// @brief The rigid motion that most pairs agree on: closed form (Umeyama), refitted on the pairs
/// within `inlier_m`, from three-point starts (seeded) if the plain fit has no majority.
/// @param pairs source and target point of each.
/// @return T_target_source; none: fewer than 3 pairs, or no majority.
[[nodiscard]] std::optional<Pose> fit_rigid(
    const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs, double inlier_m = 0.03);

}  // namespace lidar_upsampling
