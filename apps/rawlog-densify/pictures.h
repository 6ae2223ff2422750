// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "bird_view.h"
#include "drawing.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief As PNG, replacing one that is there. @throw std::runtime_error as OutputFile
void write_picture(const std::string& path, const cv::Mat& picture);

/// @brief Pictures of virtual scans: on the camera image, coloured by depth, and from above beside
/// the last real scan, with the trails of moving objects.
class Pictures {
 public:
  /// @throw std::runtime_error the folder cannot be made.
  explicit Pictures(std::string folder);

  void real_scan(const LidarScan& scan);
  void image(const CameraImage& image) { images_[image.camera.label] = image; }

  /// Writes `<number>_<camera>.png` for each camera that took its picture then, and
  /// `<number>_from_above.png`. @throw std::runtime_error a file cannot be written.
  void virtual_scan(const VirtualScan& scan);

 private:
  void write(const std::string& name, const cv::Mat& picture) const;

  std::string folder_;
  FileNames names_;  ///< of cameras
  int number_ = 0;
  LidarScan real_;
  std::map<std::string, CameraImage> images_;
  Trails trails_;
  BirdView view_;      ///< by the first scan
  DepthScale depths_;  ///< by the first scan
};

}  // namespace lidar_upsampling
