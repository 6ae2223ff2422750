// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// How virtual scans travel.
struct OutputForm {
  Carrier carrier = Carrier::automatic;
  bool annotate = false;  ///< each is followed by its objects, as a scene for viewers
};

/// What the settings say of it. @throw std::invalid_argument no such carrier.
[[nodiscard]] OutputForm output_form(const Config& config);

/// @brief A virtual scan as stock observations, all with the image's stamp, in the order that they
/// go out: the scan, and with `annotate` its objects, labelled as the LiDAR and `_OBJECTS`.
/// @param real the last real scan as it came in.
[[nodiscard]] std::vector<mrpt::obs::CObservation::Ptr> virtual_observations(
    const VirtualScan& scan, const OutputForm& form, const mrpt::obs::CObservation& real);

}  // namespace lidar_upsampling
