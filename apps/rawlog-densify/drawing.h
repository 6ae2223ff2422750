// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Neighbouring numbers have colours that are far apart.
[[nodiscard]] cv::Scalar color_of_track(int track);

void draw_dot(cv::Mat& picture, double u, double v, double radius, const cv::Scalar& color);
void draw_text(cv::Mat& picture, const std::string& text, cv::Point at, double size,
               const cv::Scalar& color);

/// Puts texts on a picture so that none covers another.
class Labels {
 public:
  explicit Labels(cv::Mat& picture) : picture_(picture) {}

  void keep_free(const cv::Rect& area) { taken_.push_back(area); }
  /// @param at the text's left end on its base line; it moves up or down from there to where it is
  /// free.
  void put(const std::string& text, cv::Point at, double size, const cv::Scalar& color);

 private:
  cv::Mat& picture_;
  std::vector<cv::Rect> taken_;
};

/// "#7 12.3 m/s"
[[nodiscard]] std::string label_of(int track, double speed_m_s);

/// How far nearly all points of a scan are away, level, m; 0 if it has none.
[[nodiscard]] double range_of_nearly_all(const LidarScan& scan);

/// Of depths by colours: red near, blue far.
struct DepthScale {
  double nearest_m = 3, farthest_m = 80;

  /// One that nearly all of a scan is on: a depth camera's is shorter than a LiDAR's.
  static DepthScale for_scan(const LidarScan& scan);
};

/// A scan of a picture's instant on the picture, coloured by depth, with the scale of colours.
[[nodiscard]] cv::Mat overlay(const LidarScan& scan, const CameraImage& image,
                              const DepthScale& scale);

/// A virtual scan on its picture, with boxes, numbers and speeds of what moves.
[[nodiscard]] cv::Mat on_image(const VirtualScan& scan, const CameraImage& image,
                               const DepthScale& scale);

}  // namespace lidar_upsampling
