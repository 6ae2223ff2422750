// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <vector>

#include "lidar_upsampling/objects/object_motion.h"

namespace lidar_upsampling {

/// @brief Tells what stands beside a mover, taken for one object with it, by the picture: vehicles
/// turn about a point beside them, and people are small, so that no part of either stands while
/// another moves. Both parts lie apart in the scan, few points move by less than the mover, and its
/// motion would not leave the others where they are.
/// @return of each correspondence, whether it stands; empty: they are one body as far as the
/// picture can tell.
[[nodiscard]] std::vector<std::uint8_t> standing_part(
    const std::vector<Correspondence>& correspondences, const MotionQuery& query,
    const ObjectMotionOptions& options);

}  // namespace lidar_upsampling
