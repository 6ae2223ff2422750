// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "evaluation.h"

namespace lidar_upsampling {

/// A virtual scan made ready to tell where objects of the key scan went in it.
struct MovedScan {
  const LidarScan* scan = nullptr;
  std::vector<int> matches;  ///< of match_by_beam() or match_in_order()
  Surface surface;           ///< of its points off the ground, only made where beams do not tell
};

[[nodiscard]] MovedScan prepare_moved_scan(const LidarScan& key, const LidarScan& virtual_scan);

/// What the rows that know nothing of an object alone are made from.
struct RowSources {
  const ScanSet& scans;
  Pose T_ego;
  MovedScan ours;
  std::optional<MovedScan> paper;
};

[[nodiscard]] RowSources prepare_rows(const ScanSet& scans, const Pose& T_ego);

/// @brief Where each row says that an object went. `constant_velocity` goes on as between the last
/// two real scans (found by registration, velocity and yaw rate over ground kept); an object that
/// cannot be registered there is left to the ego-motion.
[[nodiscard]] Estimates estimates_of(const ObjectReference& object, const RowSources& sources);

}  // namespace lidar_upsampling
