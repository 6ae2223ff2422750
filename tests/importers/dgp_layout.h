// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "small_street.h"

namespace lidar_upsampling {

/// The street as a scene in the DGP layout, with one camera CAMERA_01 whose pictures are taken
/// 10 ms after the scans. Every scan labels all of the street's objects.
struct DgpScene {
  explicit DgpScene(const std::filesystem::path& folder);

  SmallStreet street;
  std::filesystem::path folder, scene_file;
  nlohmann::json scene;  ///< what is in the file

  void write_scene() const;
  /// Files of frame i.
  [[nodiscard]] std::filesystem::path sweep(int frame) const;
  [[nodiscard]] std::filesystem::path labels(int frame) const;
};

[[nodiscard]] Stamp dgp_picture_stamp(int frame);

}  // namespace lidar_upsampling
