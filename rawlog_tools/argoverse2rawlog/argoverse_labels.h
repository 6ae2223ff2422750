// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "argoverse2rawlog/argoverse_log.h"
#include "import/object_tracks.h"

namespace lidar_upsampling::argoverse {

/// @brief The objects of the sweeps' `tracked_object_labels_<ns>.json` over ground, numbered as
/// they first appear. Sweeps without a pose of the vehicle are left out.
/// @throw std::runtime_error with the file and what is missing in it.
[[nodiscard]] std::vector<importing::ObjectTrack> read_tracks(const std::vector<StampedFile>& files,
                                                              const Trajectory& ego);

}  // namespace lidar_upsampling::argoverse
