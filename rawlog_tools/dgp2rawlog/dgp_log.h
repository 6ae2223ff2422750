// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "dgp2rawlog/dgp_scene.h"
#include "import/label_files.h"
#include "import/log_items.h"
#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling::dgp {

/// @brief The points and intensities of a sweep, without those that are not finite or in the
/// origin.
/// @throw std::runtime_error the file is none of rows x, y, z, intensity.
[[nodiscard]] LidarScan read_sweep(const Sweep& sweep);

/// The vehicle's pose at every file, once for each stamp.
[[nodiscard]] std::vector<PoseSample> poses_of(const Scene& scene);

/// Every sweep, picture and pose (label POSE), sweeps in the class of `carrier`. The scene must
/// outlive the items.
[[nodiscard]] std::vector<importing::LogItem> items_of(const Scene& scene,
                                                       Carrier carrier = Carrier::automatic);

[[nodiscard]] importing::LabelledLog labelled_log(const Scene& scene,
                                                  std::vector<importing::ObjectTrack> tracks);

}  // namespace lidar_upsampling::dgp
