// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>
#include <fstream>

namespace lidar_upsampling {

/// A made-up rig in KITTI's files: the lidar 0.8 m ahead of the OXTS unit, four cameras of 60 x 20
/// pixels.
inline void write_kitti_calibration(const std::filesystem::path& day) {
  std::filesystem::create_directories(day);
  std::ofstream(day / "calib_imu_to_velo.txt")
      << "calib_time: 25-May-2012 16:47:16\nR: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n";
  // About its +Z, the camera is turned by atan(3/4).
  std::ofstream(day / "calib_velo_to_cam.txt")
      << "R: 0.6 -0.8 0 0 0 -1 0.8 0.6 0\nT: -0.01 -0.08 -0.27\ndelta_f: 0 0\n";
  std::ofstream cams(day / "calib_cam_to_cam.txt");
  cams << "corner_dist: 9.95e-02\nR_rect_00: 0.8 0 0.6 0 1 0 -0.6 0 0.8\n";
  const char* const offsets[] = {"0", "-3.1", "0.36", "-2.7"};
  for (int i = 0; i < 4; ++i) {
    cams << "S_rect_0" << i << ": 60 20\n"
         << "P_rect_0" << i << ": 57 0 29.5 " << offsets[i] << " 0 58 9.5 0.02 0 0 1 0.0027\n";
  }
}

}  // namespace lidar_upsampling
