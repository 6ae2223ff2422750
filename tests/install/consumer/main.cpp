// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <iostream>

#include "lidar_upsampling/upsampler.h"

int main() {
  lidar_upsampling::LidarUpsampler upsampler{lidar_upsampling::Config()};
  lidar_upsampling::LidarScan scan;
  scan.points = {{5, 0, 0}, {6, 1, 0}};
  upsampler.insert_scan(scan);
  std::cout << "scans without images: " << (upsampler.flush() ? "some" : "no") << " virtual scan\n";
}
