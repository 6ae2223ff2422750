// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/upsampler.h"
#include "simulator/world.h"

namespace lidar_upsampling::bench {

/// A real scan and the pictures up to the next one; the first shows the scan's own instant.
struct Cycle {
  LidarScan scan;
  std::vector<CameraImage> images;
};

/// @brief A drive of the size of KITTI's: 64 x 2083 beams at 10 Hz, 1242x375 pixels at 30 Hz, some
/// ten road users in view, no poses given. Simulated at first use and kept in memory.
struct Scene {
  sim::World world;
  Pose T_camera_lidar = Pose::Identity();
  std::vector<Cycle> cycles;

  /// Of the static world, in the lidar frame.
  [[nodiscard]] Pose T_lidar_t_lidar_k(Stamp k, Stamp t) const;
};

[[nodiscard]] const Scene& scene();

/// @brief An upsampler on that drive, without end: it starts anew after the last cycle. The first
/// cycle is given to it beforehand, so that everything it learns from the scan before is there.
class Feed {
 public:
  Feed();
  /// To be used up before the next call.
  [[nodiscard]] const Cycle& next();
  [[nodiscard]] LidarUpsampler& upsampler() { return *upsampler_; }

 private:
  void start();

  std::optional<LidarUpsampler> upsampler_;
  std::size_t next_ = 0;
};

}  // namespace lidar_upsampling::bench
