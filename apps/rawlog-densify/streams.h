// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/rig_overrides.h"

namespace lidar_upsampling {

/// The streams of a log that a densification uses.
struct StreamSelection {
  const StreamInfo* lidar = nullptr;
  std::vector<const StreamInfo*> cameras;
};

/// Cameras whose intrinsics come from the settings.
[[nodiscard]] std::vector<std::string> labels_of_calibrated(const RigOverrides& rig);

/// @brief The LiDAR and the cameras that the settings name, or the ones there are.
/// @param calibrated_elsewhere labels of cameras whose calibration comes from the settings.
/// @throw std::runtime_error no such label (with those there are), several LiDARs to choose from,
/// no images, images without calibration, clocks that do not overlap.
[[nodiscard]] StreamSelection select_streams(const LogIndex& index, const Config& config,
                                             const std::vector<std::string>& calibrated_elsewhere);

/// @brief The same of a log of which some has been read, once all that is needed is there: clocks
/// are not compared.
[[nodiscard]] StreamSelection select_again(const LogIndex& index, const Config& config,
                                           const std::vector<std::string>& calibrated_elsewhere);

}  // namespace lidar_upsampling
