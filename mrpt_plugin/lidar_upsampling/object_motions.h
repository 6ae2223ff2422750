// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/image_result.h"
#include "lidar_upsampling/sights.h"

namespace lidar_upsampling {

/// @brief Each object's motion at an instant, from all cameras' pictures of it. The tracks learn
/// what the pictures tell.
/// @param group the pictures, `newest` among them. @param rig all cameras; what none of the group
/// shows may be in view of one that shutters at another time.
[[nodiscard]] std::vector<ObjectMotion> estimate_motions(const std::vector<ImageResult>& group,
                                                         const ImageResult& newest,
                                                         const KeyObjects& objects,
                                                         const std::vector<const Camera*>& rig,
                                                         TrackStore& store, const Config& config);

}  // namespace lidar_upsampling
