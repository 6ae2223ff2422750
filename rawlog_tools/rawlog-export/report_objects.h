// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lidar_upsampling/scene/object_scene.h"

namespace lidar_upsampling::exporting {

/// The objects of one instant.
struct ObjectsAt {
  std::vector<ObjectBox> boxes;
  Pose T_rest_lidar = Pose::Identity();  ///< lidar frame in one at rest, the first scan's
};

/// @brief The boxes in a report of `rawlog-densify --report`.
/// @throw std::runtime_error with the file: not readable, or no such report.
[[nodiscard]] std::map<Stamp, ObjectsAt> read_report(const std::string& path);

}  // namespace lidar_upsampling::exporting
