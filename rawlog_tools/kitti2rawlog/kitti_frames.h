// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <optional>
#include <string>

#include "kitti2rawlog/kitti_drive.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::kitti {

/// @brief The points and intensities of a velodyne_points file, in file order, without those that
/// are not finite or in the origin; with ring and column if they are to be had (see hdl64_rings.h).
/// @throw std::runtime_error the file cannot be read, or does not hold whole points.
[[nodiscard]] LidarScan read_scan(const Frame& frame, const Pose& T_vehicle_lidar);

/// @brief Turns OXTS records into poses. The world is East-North-Up, its origin at the first
/// record.
class OxtsReader {
 public:
  /// @throw std::runtime_error the file does not start with the six numbers of position and
  /// attitude.
  [[nodiscard]] Pose T_world_vehicle(const std::string& path);

 private:
  std::optional<GeographicLib::LocalCartesian> world_;
};

}  // namespace lidar_upsampling::kitti
