// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/rig_overrides.h"

namespace lidar_upsampling {

/// @brief Puts the poses of the settings' file, if they name one, in the place of the log's own.
/// @param index of the log `index.path`.
/// @throw std::runtime_error as read_pose_file(); no sensor of that label; poses of another time.
/// @throw std::invalid_argument the settings want the ego-motion from elsewhere.
void take_poses_from_file(const Config& config, const RigOverrides& rig, LogIndex& index);

}  // namespace lidar_upsampling
