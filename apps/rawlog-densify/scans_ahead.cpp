// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scans_ahead.h"

#include <mrpt/obs/CSensoryFrame.h>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/sensory_frame.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;

std::optional<LidarScan> ScansAhead::next() {
  while (read_.empty() && !at_end_) read_on();
  if (read_.empty()) return {};
  LidarScan scan = std::move(read_.front());
  read_.pop_front();
  return scan;
}

void ScansAhead::read_on() {
  std::vector<RawlogEntry> entries;
  try {
    if (auto entry = reader_.next()) entries.push_back(std::move(*entry));
  } catch (const CorruptRawlog&) {
  }
  at_end_ = entries.empty();
  if (!at_end_ && dynamic_cast<mrpt::obs::CSensoryFrame*>(entries[0].object.get()) != nullptr)
    entries = split_frame(entries[0]);
  for (const RawlogEntry& entry : entries) {
    const auto observation = std::dynamic_pointer_cast<CObservation>(entry.object);
    if (!observation || observation->sensorLabel != lidar_label_ || !is_lidar_scan(*observation))
      continue;
    try {
      auto scan = scan_from_observation(*observation);
      if (!scan || scan->points.empty()) continue;
      apply(rig_, *scan);
      read_.push_back(std::move(*scan));
    } catch (const std::runtime_error&) {  // told when its own turn comes
    }
  }
}

}  // namespace lidar_upsampling
