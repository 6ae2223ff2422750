// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/image_result.h"
#include "lidar_upsampling/sights.h"

namespace lidar_upsampling {

/// @brief Each object's motion at an instant, from all cameras' pictures of it. The tracks learn
/// what the pictures tell.
/// @param group the pictures, `newest` among them.
[[nodiscard]] std::vector<ObjectMotion> estimate_motions(const std::vector<ImageResult>& group,
                                                         const ImageResult& newest,
                                                         const KeyObjects& objects,
                                                         TrackStore& store, const Config& config);

}  // namespace lidar_upsampling
