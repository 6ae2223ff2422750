// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <mutex>
#include <set>
#include <string>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/rig_overrides.h"
#include "plugin/work_queue.h"

namespace lidar_upsampling {

/// @brief Learns, as observations come, which label is the LiDAR's and which are the cameras':
/// those of the settings, else the first 3D scan's and every image's that has a calibration.
class LiveStreams {
 public:
  LiveStreams(const Config& config, const RigOverrides& rig);

  /// @throw std::runtime_error an image of a camera that the settings name has no calibration, or
  /// the sources hold virtual scans already.
  [[nodiscard]] Role role_of(const mrpt::obs::CObservation& observation);

  /// What came so far, for a message on why there was nothing to do.
  [[nodiscard]] std::string seen() const;

 private:
  [[nodiscard]] bool is_camera(const mrpt::obs::CObservation& observation) const;

  mutable std::mutex mutex_;
  const Config& config_;
  const RigOverrides& rig_;
  std::string lidar_label_;
  std::set<std::string> camera_labels_, other_labels_;
};

}  // namespace lidar_upsampling
