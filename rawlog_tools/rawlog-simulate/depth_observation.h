// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "simulator/scenario.h"

namespace lidar_upsampling::sim {

/// @brief What a depth camera's driver writes: a dense picture of depths along +X in 16-bit
/// millimetres with its intrinsics, 0 where there is no return, and no points.
/// @param scan with rings and columns, of a `spec` that has a depth camera.
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr depth_observation(const LidarScan& scan,
                                                                        const LidarSpec& spec);

}  // namespace lidar_upsampling::sim
