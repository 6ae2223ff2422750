// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "densify.h"

namespace lidar_upsampling {

/// @brief The settings of a job: defaults, over them a file, over it single settings.
/// @param path INI file, empty: none.
/// @param sets `name=value` of the main section or `section.name=value`.
/// @param detections file of boxes that takes the detector's place, empty: none.
/// @throw std::runtime_error, std::invalid_argument naming file, section and key at fault.
void load_settings(DensifyJob& job, const std::string& path, const std::vector<std::string>& sets,
                   const std::string& detections);

}  // namespace lidar_upsampling
