// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "kitti2rawlog/kitti_drive.h"

namespace lidar_upsampling::kitti {

/// @brief The stamps of an odometry sequence: `times.txt` holds seconds from its first frame, which
/// is put at 1970-01-01 00:00:00 UTC.
/// @throw std::runtime_error the file cannot be read, or has a line that is no time.
[[nodiscard]] FrameStamps read_times(const std::string& path);

/// @brief The poses of a sequence, one row of T_world_camera_0 (3 x 4, row by row) per frame, as
/// poses of the vehicle. The world is the vehicle's frame where the file's is that of camera 0: at
/// the first frame.
/// @throw std::runtime_error the file cannot be read, or has a row of other than 12 numbers.
[[nodiscard]] std::vector<Pose> read_poses(const std::string& path, const Pose& T_vehicle_camera_0);

}  // namespace lidar_upsampling::kitti
