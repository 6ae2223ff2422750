// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <string>
#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/rig_overrides.h"

namespace lidar_upsampling {

/// The settings of a live sensor: its own, and those of the method.
struct SensorSettings {
  std::string rawlog;                ///< log to play; empty: `sources` deliver
  double speed = 1;                  ///< of playing; 0: as fast as the work is done
  std::vector<std::string> sources;  ///< sections of drivers
  double max_wait_ms = 100;          ///< of a scan or an image for the work; half of it hurries
  double merge_window_ms = 20;       ///< sources: what an observation may arrive later than others
  double linger_s = 30;              ///< at the end, at most, until all that was handed out is used
  bool into_frames = false;          ///< whether rawlog-grabber makes sensory frames
  Config config;
  RigOverrides rig;
};

/// @brief Reads a sensor's section, beside which a file for rawlog-grabber holds the steps'
/// sections, as [klt], with `rawlog-grabber-ignore = true`.
/// @throw std::invalid_argument naming section and key: misspelt, out of range, or neither or both
/// of `rawlog` and `sources`.
[[nodiscard]] SensorSettings load_sensor_settings(const mrpt::config::CConfigFileBase& source,
                                                  const std::string& section);

}  // namespace lidar_upsampling
