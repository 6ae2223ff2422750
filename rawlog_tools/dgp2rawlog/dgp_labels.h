// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "dgp2rawlog/dgp_scene.h"
#include "import/object_tracks.h"

namespace lidar_upsampling::dgp {

struct SceneLabels {
  std::vector<importing::ObjectTrack> tracks;  ///< numbered as they first appear
  std::vector<std::string> warnings;           ///< what is not labelled, in a line each
};

/// @brief The objects of the sweeps' `bounding_box_3d` files over ground.
/// @throw std::runtime_error no sweep has labels; or with the file, what is missing or malformed in
/// it, an object twice in a sweep, a box without extent.
[[nodiscard]] SceneLabels read_labels(const Scene& scene);

}  // namespace lidar_upsampling::dgp
