// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>

#include "report_objects.h"

namespace lidar_upsampling::exporting {

/// @brief A scan for SceneViewer3D, in the vehicle frame, with the objects of its instant.
/// @throw std::runtime_error the file cannot be written.
void write_scene(const std::string& path, const LidarScan& scan, const ObjectsAt& objects);

/// @brief The way of one object, in the frame of the first scan's vehicle at rest: its boxes, the
/// path of its centre, and the scan nearest to the middle of it.
/// @param scan taken at one of the instants. @throw std::runtime_error as above.
void write_trail(const std::string& path, int track, const std::map<Stamp, ObjectsAt>& objects,
                 const LidarScan& scan);

/// @return the instants at which the track has a box.
[[nodiscard]] std::vector<Stamp> instants_of(int track, const std::map<Stamp, ObjectsAt>& objects);

}  // namespace lidar_upsampling::exporting
