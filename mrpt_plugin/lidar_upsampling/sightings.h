// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/camera_view.h"

namespace lidar_upsampling {

/// What the key scan shows of an object on one camera.
struct Sighting {
  Detection detection;
  std::vector<int> points;              ///< indices into the key scan, ascending
  std::optional<KnownMotion> foreseen;  ///< told by later scans
};

/// @brief Joins who will be found to move with what the key scan shows. One in a cluster with what
/// stays behind is parted from it; one that is no sighting yet becomes one where the picture shows
/// it.
void find_expected(std::vector<Sighting>& sightings, const KeyScanView& key,
                   const CameraModel& camera, const Pose& T_camera_lidar);

}  // namespace lidar_upsampling
