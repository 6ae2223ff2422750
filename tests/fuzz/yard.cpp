// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/yard.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lidar_upsampling::fuzz {
namespace {

constexpr int kWidth = 96, kHeight = 48;

double box_at(int instant) { return -1 + 0.15 * instant; }  // of its middle, to the left

double elevation_of(int ring) { return (-15 + 2 * ring) * M_PI / 180; }

}  // namespace

Stamp stamp_at(int instant) {
  return shifted(Stamp(mrpt::Clock::duration(132000000000000000LL)), instant / 30.);
}

// Nearest of ground, walls around, and a box 7 m ahead.
double range_of(double azimuth, double elevation, int instant) {
  constexpr double kToWall = 14, kToBox = 7, kHalfBox = 0.9, kTopOfBox = 1.8;
  const double ahead = std::cos(azimuth), left = std::sin(azimuth), up = std::tan(elevation);
  double level = kToWall / std::max(std::abs(ahead), std::abs(left));
  if (up < 0) level = std::min(level, -kHeightOfSensors / up);
  const double to_box = kToBox / ahead;
  const bool meets = ahead > 0 && std::abs(to_box * left - box_at(instant)) < kHalfBox &&
                     to_box * up + kHeightOfSensors < kTopOfBox;
  if (meets) level = std::min(level, to_box);
  return level * std::hypot(1., up);
}

LidarScan scan_at(int instant) {
  LidarScan scan;
  scan.label = "LIDAR";
  scan.stamp = stamp_at(instant);
  scan.T_vehicle_lidar.translation().z() = kHeightOfSensors;
  scan.num_rings = kRings;
  scan.num_columns = kColumns;
  for (int ring = 0; ring < kRings; ++ring)
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2 * M_PI * column / kColumns, elevation = elevation_of(ring);
      const double range = range_of(azimuth, elevation, instant);
      const double level = range * std::cos(elevation);
      scan.points.emplace_back(Eigen::Vector3d(level * std::cos(azimuth), level * std::sin(azimuth),
                                               range * std::sin(elevation))
                                   .cast<float>());
      scan.ring.push_back(static_cast<std::uint16_t>(ring));
      scan.column.push_back(static_cast<std::uint16_t>(column));
      scan.intensity.push_back(0.5F);
      scan.time_s.push_back(0.1F * static_cast<float>(column) / kColumns);
    }
  return scan;
}

CameraImage picture_at(int instant) {
  CameraImage image;
  image.stamp = stamp_at(instant);
  image.camera.label = "CAM";
  CameraModel& model = image.camera.model;
  model.width = kWidth;
  model.height = kHeight;
  model.fx = model.fy = 60;
  model.cx = kWidth / 2.;
  model.cy = kHeight / 2.;
  image.camera.T_vehicle_camera.translation() << 0.2, 0, kHeightOfSensors;
  image.camera.T_vehicle_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  image.bgr = cv::Mat(kHeight, kWidth, CV_8UC3);
  cv::RNG(7).fill(image.bgr, cv::RNG::UNIFORM, 0, 256);
  cv::Mat surface(14, 16, CV_8UC3);
  cv::RNG(8).fill(surface, cv::RNG::UNIFORM, 0, 256);
  const int left = static_cast<int>(model.cx - 60 * box_at(instant) / 7) - surface.cols / 2;
  surface.copyTo(image.bgr(cv::Rect(left, kHeight / 2, surface.cols, surface.rows)));
  cv::GaussianBlur(image.bgr, image.bgr, {3, 3}, 0.8);
  return image;
}

}  // namespace lidar_upsampling::fuzz
