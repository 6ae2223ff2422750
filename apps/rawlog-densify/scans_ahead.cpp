// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scans_ahead.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <utility>

#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;

std::optional<LidarScan> ScansAhead::next() {
  if (read_.empty()) return {};
  LidarScan scan = std::move(read_.front());
  read_.pop_front();
  return scan;
}

void ScansAhead::add(const RawlogEntry& entry) {
  if (const auto* const frame = dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get()))
    for (const CObservation::Ptr& observation : *frame) add_observation(*observation);
  else if (const auto* const observation = dynamic_cast<CObservation*>(entry.object.get()))
    add_observation(*observation);
}

void ScansAhead::add_observation(const CObservation& observation) {
  if (observation.sensorLabel != lidar_label_ || !is_lidar_scan(observation)) return;
  if (auto scan = usable_.scan(observation)) read_.push_back(std::move(*scan));
}

}  // namespace lidar_upsampling
