// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::dgp {

/// One file of one sensor.
struct SensorFile {
  Stamp stamp;
  std::string path;
  std::string sensor;  ///< its name, as CAMERA_01
  Pose T_vehicle_sensor = Pose::Identity();
  Pose T_world_vehicle = Pose::Identity();
};

struct Sweep {
  SensorFile file;
  std::string labels;  ///< file of its 3D boxes; empty: it has none
};

struct Picture {
  SensorFile file;
  Camera camera;
};

/// A scene in the layout of the Dataset Governance Policy (TRI-ML/dgp), as of DDAD.
struct Scene {
  std::string path;               ///< of the scene_*.json
  std::string ontology;           ///< file of the 3D boxes' classes; empty: there is none
  std::vector<Sweep> sweeps;      ///< in time order, as
  std::vector<Picture> pictures;  ///< these
};

/// @brief Reads `scene_*.json` and the calibration files.
/// @param path of the scene's folder or, where that holds several, of the one file.
/// @param cameras whose pictures are wanted, by name; empty: all.
/// @throw std::runtime_error with the file and what is missing or malformed in it; a camera that is
/// not there, and those that are; no scans.
[[nodiscard]] Scene open_scene(const std::string& path, const std::vector<std::string>& cameras);

/// @brief When a file was taken. Named by digits that are a UNIX time (16 for microseconds to 19
/// for nanoseconds) it is that, as DDAD's scene files tell times in the 25th century; else the
/// scene file's time.
/// @param iso_time as 2019-05-03T21:39:53.820375Z.
/// @return none if neither is a time.
[[nodiscard]] std::optional<Stamp> stamp_of(const std::string& path, const std::string& iso_time);

}  // namespace lidar_upsampling::dgp
