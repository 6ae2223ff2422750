// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A virtual scan as stock observations, all with the image's stamp, in the order that they
/// go out: the scan in the settings' carrier, and with `annotate` its objects as a scene for
/// viewers, labelled as the LiDAR and `_OBJECTS`.
/// @param real the last real scan as it came in.
/// @throw std::invalid_argument no such carrier.
[[nodiscard]] std::vector<mrpt::obs::CObservation::Ptr> virtual_observations(
    const VirtualScan& scan, const Config& config, const mrpt::obs::CObservation& real);

}  // namespace lidar_upsampling
