// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationComment.h>

#include <string>

#include "plugin/work_queue.h"

namespace lidar_upsampling {

/// An observation of no content, so many ms after some instant.
inline mrpt::obs::CObservation::Ptr observed(const std::string& label, double ms) {
  auto observation = mrpt::obs::CObservationComment::Create();
  observation->sensorLabel = label;
  observation->timestamp = shifted(mrpt::Clock::fromDouble(1e9), 1e-3 * ms);
  return observation;
}

/// "CAM0 33": what and when.
inline std::string name_of(const mrpt::obs::CObservation& observation) {
  const double ms = 1e3 * seconds_between(mrpt::Clock::fromDouble(1e9), observation.timestamp);
  return observation.sensorLabel + " " + std::to_string(std::lround(ms));
}

inline Arrived arrived(const std::string& label, double ms, Role role) {
  Arrived result;
  result.observation = observed(label, ms);
  result.role = role;
  return result;
}

}  // namespace lidar_upsampling
