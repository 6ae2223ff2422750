// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A scan of a picture's instant on the picture, coloured by depth: red near, blue far.
[[nodiscard]] cv::Mat overlay(const LidarScan& scan, const CameraImage& image);

/// @brief Pictures of virtual scans: on the camera image, coloured by depth, and from above beside
/// the last real scan, with the trails of moving objects.
class Pictures {
 public:
  /// @throw std::runtime_error the folder cannot be made.
  explicit Pictures(std::string folder);

  void real_scan(const LidarScan& scan) { real_ = scan; }
  void image(const CameraImage& image) { images_[image.camera.label] = image; }

  /// Writes `<number>_<camera>.png` for each camera that took its picture then, and
  /// `<number>_from_above.png`. @throw std::runtime_error a file cannot be written.
  void virtual_scan(const VirtualScan& scan);

 private:
  struct TrailPoint {
    Stamp stamp;
    Eigen::Vector3d position_at_rest;
  };
  void remember_trails(const VirtualScan& scan);
  [[nodiscard]] cv::Mat from_above(const VirtualScan& scan) const;
  void write(const std::string& name, const cv::Mat& picture) const;

  std::string folder_;
  int number_ = 0;
  LidarScan real_;
  std::map<std::string, CameraImage> images_;
  std::map<int, std::vector<TrailPoint>> trails_;
};

}  // namespace lidar_upsampling
