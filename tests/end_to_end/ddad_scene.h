// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// One instant of a scene in the DGP layout.
struct DgpSample {
  LidarScan scan;
  Pose T_world_vehicle = Pose::Identity();
  std::vector<CameraImage> images;
};

/// @brief All samples of the one scene in a folder. Stamps are those in the files' names.
/// @throw std::runtime_error a file is missing or not of the format expected.
[[nodiscard]] std::vector<DgpSample> load_dgp_scene(const std::filesystem::path& folder);

}  // namespace lidar_upsampling
