// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/scenario.h"
#include "simulator/section_reader.h"

namespace lidar_upsampling::sim {

/// @brief A spinning scanner or a depth camera, from the section that describes it.
/// @throw std::invalid_argument naming section and key: unknown, or a value that cannot be.
void read_lidar(SectionReader section, LidarSpec& lidar);

/// @param label where the section gives none. @throw as above.
[[nodiscard]] CameraSpec read_camera(SectionReader section, const std::string& label);

}  // namespace lidar_upsampling::sim
