// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/replay_driver.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/core/initializer.h>

#include <chrono>
#include <stdexcept>

#include "end_to_end/pipeline.h"

IMPLEMENTS_GENERIC_SENSOR(ReplayDriver, lidar_upsampling)
MRPT_INITIALIZER(registerReplayDriver) { lidar_upsampling::ReplayDriver::doRegister(); }

namespace lidar_upsampling {
namespace {

// Common to all drivers, as the time of day is.
double seconds_played() {
  static const auto start = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void ReplayDriver::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                             const std::string& section) {
  const auto all = observations_of(source.read_string(section, "log", "", true));
  first_stamp_ = all.front().stamp();
  for (const Logged& logged : with_label(all, source.read_string(section, "label", "", true)))
    pending_.push_back(logged.observation);
  delay_s_ = 1e-3 * source.read_double(section, "delay_ms", 0);
  fail_after_ = source.read_int(section, "fail_after", -1);
}

void ReplayDriver::doProcess() {
  if (num_played_ == fail_after_) throw std::runtime_error("the cable came off");
  const double now_s = seconds_played();
  while (!pending_.empty() && num_played_ != fail_after_ &&
         seconds_between(first_stamp_, pending_.front()->timestamp) + delay_s_ <= now_s) {
    appendObservation(pending_.front());
    pending_.pop_front();
    ++num_played_;
  }
}

}  // namespace lidar_upsampling
