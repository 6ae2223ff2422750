// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "end_to_end/pipeline.h"
#include "plugin/upsampled_lidar_sensor.h"

namespace lidar_upsampling {

/// Label of what a sensor appends at its end.
inline constexpr const char* kFiller = "FILLER";

/// A sensor, and all that it has handed out.
struct LiveRun {
  explicit LiveRun(const std::string& lines, const std::string& sections = {}) {
    mrpt::config::CConfigFileMemory file;
    file.setContent("[SENSOR]\ndriver = UpsampledLidarSensor\nprocess_rate = 100\nsensorLabel = " +
                    std::string(kFiller) + "\n" + lines + "\n" + sections);
    sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    sensor.loadConfig(file, "SENSOR");
    sensor.initialize();
  }

  void process() {
    sensor.doProcess();
    for (const auto& [stamp, object] : sensor.getObservations())
      all.push_back(std::dynamic_pointer_cast<mrpt::obs::CObservation>(object));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  /// What it throws at its end.
  std::string run_to_end() {
    try {
      while (true) process();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  [[nodiscard]] std::size_t count(const std::string& label) const {
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const auto& one) { return one->sensorLabel == label; }));
  }

  UpsampledLidarSensor sensor;
  std::vector<mrpt::obs::CObservation::Ptr> all;
};

/// Lines of a sensor's section: plays in.rawlog of the folder.
inline std::string playing(const TestFolder& folder, const std::string& speed) {
  return "rawlog = " + folder / "in.rawlog" + "\nspeed = " + speed + "\nlinger_s = 0";
}

}  // namespace lidar_upsampling
