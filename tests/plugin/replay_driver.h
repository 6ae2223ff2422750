// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation.h>

#include <deque>

namespace lidar_upsampling {

/// A driver for tests: plays one label (`label`) of a log (`log`), every observation at its time
/// and `delay_ms` later. `fail_after` so many it breaks down.
class ReplayDriver : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(ReplayDriver)

 public:
  void doProcess() override;

 private:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                 const std::string& section) override;

  std::deque<mrpt::obs::CObservation::Ptr> pending_;
  mrpt::Clock::time_point first_stamp_;
  double delay_s_ = 0;
  int fail_after_ = -1;
  int num_played_ = 0;
};

}  // namespace lidar_upsampling
