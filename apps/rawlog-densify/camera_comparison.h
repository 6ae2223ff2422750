// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "check.h"
#include "lidar_upsampling/ego/time_offset.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A scan that is looked at, and how the lidar moved about its stamp.
struct PlacedScan {
  LidarScan scan;
  std::function<Pose(double)> lidar_step;  ///< T_lidar_t_lidar_k, t in s from the stamp on; null:
                                           ///< not known
  std::shared_ptr<const LidarScan> before;
};

/// @brief Some of a camera's pictures, each laid beside a scan, whichever of the two a log brings
/// first.
class CameraComparison {
 public:
  /// @param offset_in_force_s of the pictures' stamps, by the settings.
  CameraComparison(const Camera& camera, double offset_in_force_s)
      : offset_in_force_s_(offset_in_force_s) {
    result_.camera = camera;
  }

  void pair(Stamp image, Stamp scan) { scan_of_image_[image] = scan; }
  /// Points of the picture's scan are drawn on it, into this file.
  void draw_on(Stamp image, std::string file) {
    drawn_ = image;
    overlay_ = std::move(file);
  }

  /// @return the picture's scan; none: it is not asked for.
  [[nodiscard]] std::optional<Stamp> scan_of(Stamp image) const;
  /// A picture whose scan has not come yet.
  void keep(CameraImage image) { waiting_[image.stamp] = std::move(image); }
  /// Lays all pictures beside it that have waited for it. @throw as compare().
  void take(const PlacedScan& scan);
  /// @throw std::runtime_error the picture with the scan's points cannot be written.
  void compare(const PlacedScan& scan, const CameraImage& image);

  [[nodiscard]] CameraCheck finish() const;

 private:
  CameraCheck result_;
  double offset_in_force_s_;
  std::map<Stamp, Stamp> scan_of_image_;
  std::map<Stamp, CameraImage> waiting_;
  std::vector<OffsetScores> scores_;
  Stamp drawn_;
  std::string overlay_;  ///< empty: none
};

}  // namespace lidar_upsampling
