// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {

/// A vehicle at rest before a wall: scans at 10 Hz, images at 30 Hz, poses with each image.
struct HandMadeLog {
  int num_instants = 10;
  int num_images = num_instants;
  bool calibrated = true;
  double image_delay_s = 0;  ///< added to the images' stamps
  int external_image = -1;   ///< the one that lies in a file
  std::string external_file = "no.png";
  std::string lidar_label = "LIDAR";
  double first_scan_delay_s = 0;  ///< added to its stamp
};

inline Stamp hand_made_stamp(int image) {
  return shifted(Stamp(mrpt::Clock::duration(132000000000000000LL)), image / 30.);
}

inline LidarScan wall_scan(int image) {
  LidarScan scan;
  scan.label = "LIDAR";
  scan.stamp = hand_made_stamp(image);
  scan.T_vehicle_lidar.translation().z() = 1.7;
  for (int ring = 0; ring < 16; ++ring) {
    for (int column = 0; column < 120; ++column) {
      const double azimuth = 2 * M_PI * column / 120;
      const double elevation = -0.3 + 0.03 * ring;
      const double to_wall = 12 / std::max(0.1, std::cos(azimuth));
      const double to_ground = elevation < 0 ? 1.7 / -std::tan(elevation) : 1e3;
      const double r = std::min({to_wall, to_ground, 60.});
      scan.points.emplace_back(
          Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), r * std::tan(elevation))
              .cast<float>());
    }
  }
  return scan;
}

inline CameraImage still_picture(const HandMadeLog& log, int image) {
  CameraImage picture;
  picture.stamp = shifted(hand_made_stamp(image), log.image_delay_s);
  picture.camera.label = "CAM";
  picture.camera.model.width = 160;
  picture.camera.model.height = 80;
  if (log.calibrated) {
    picture.camera.model.fx = picture.camera.model.fy = 90;
    picture.camera.model.cx = 80;
    picture.camera.model.cy = 40;
  }
  picture.camera.T_vehicle_camera.translation() << 0.3, 0, 1.6;
  picture.camera.T_vehicle_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  picture.bgr = cv::Mat(80, 160, CV_8UC3);
  cv::RNG(7).fill(picture.bgr, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

inline void write_hand_made(const std::string& path, const HandMadeLog& log = {}) {
  RawlogWriter writer(path, false);
  for (int i = 0; i < log.num_instants; ++i) {
    mrpt::obs::CObservationRobotPose pose;
    pose.sensorLabel = "POSE";
    pose.timestamp = hand_made_stamp(i);
    writer.write(pose);
    if (i % 3 == 0) {
      LidarScan scan = wall_scan(i);
      scan.label = log.lidar_label;
      if (i == 0) scan.stamp = shifted(scan.stamp, log.first_scan_delay_s);
      writer.write(*observation_from_scan(scan, Carrier::automatic));
    }
    if (i >= log.num_images) continue;
    const auto picture = observation_from_image(still_picture(log, i));
    if (i == log.external_image) picture->image.setExternalStorage(log.external_file);
    writer.write(*picture);
  }
  writer.commit();
}

}  // namespace lidar_upsampling
