// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/hwdrivers/CGenericSensor.h>

#include <string>
#include <thread>
#include <vector>

#include "plugin/pipeline.h"
#include "plugin/source.h"
#include "plugin/stop_signal.h"

namespace lidar_upsampling {

/// A driver of MRPT's, or of another module, and the section it was set up from.
struct Driver {
  std::string section;
  mrpt::hwdrivers::CGenericSensor::Ptr sensor;
};

/// @brief Makes the drivers that sections name with `driver=`, and loads their settings.
/// @throw std::runtime_error naming the section: it is not there, has no known driver, or the
/// driver refuses it.
[[nodiscard]] std::vector<Driver> make_drivers(const mrpt::config::CConfigFileBase& config,
                                               const std::vector<std::string>& sections);

/// @brief Polls drivers, each in a thread at its own `process_rate`. When one fails, all end.
class DriverSources : public Source {
 public:
  /// Starts the drivers. @throw std::runtime_error naming the section whose driver does not start.
  DriverSources(std::vector<Driver> drivers, Pipeline& pipeline);
  ~DriverSources() override;
  DriverSources(const DriverSources&) = delete;
  DriverSources& operator=(const DriverSources&) = delete;

 private:
  void poll(const Driver& driver);

  std::vector<Driver> drivers_;
  Pipeline& pipeline_;
  StopSignal stop_;
  std::vector<std::thread> threads_;
};

}  // namespace lidar_upsampling
