// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

namespace lidar_upsampling {

/// While one lives, what this thread prints to std::cerr is lost: MRPT and OpenCV tell of damaged
/// data by themselves.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

}  // namespace lidar_upsampling
