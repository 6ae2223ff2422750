// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scan_feed.h"

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling {

ScanFeed::ScanFeed(const std::string& path, std::function<bool(const std::string&, Stamp)> wanted)
    : reader_(path), wanted_(std::move(wanted)) {}

std::optional<LidarScan> ScanFeed::next() {
  const auto take = [this](mrpt::obs::CObservation& observation) {
    if (!is_lidar_scan(observation) || !wanted_(observation.sensorLabel, observation.timestamp))
      return;
    if (auto scan = scan_from_observation(observation)) waiting_.push_back(std::move(*scan));
  };
  while (waiting_.empty()) {
    const auto entry = reader_.next();
    if (!entry) return std::nullopt;
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry->object)) {
      for (const auto& observation : *frame) take(*observation);
    } else if (const auto observation =
                   std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry->object)) {
      take(*observation);
    }
  }
  LidarScan scan = std::move(waiting_.front());
  waiting_.pop_front();
  return scan;
}

ReferenceScans::ReferenceScans(const std::string& path, const std::string& label,
                               std::vector<Stamp> stamps, double tolerance_s)
    : stamps_(std::move(stamps)),
      tolerance_s_(tolerance_s),
      feed_(path, [this, label](const std::string& of_scan, Stamp stamp) {
        return of_scan == label && stamp >= asked_;
      }) {
  std::sort(stamps_.begin(), stamps_.end());
}

const LidarScan* ReferenceScans::nearest(Stamp stamp) {
  const auto next = std::lower_bound(stamps_.begin(), stamps_.end(), stamp);
  const auto off = [stamp](Stamp other) { return std::abs(seconds_between(stamp, other)); };
  auto best = next;
  if (next != stamps_.begin() && (next == stamps_.end() || off(*std::prev(next)) < off(*next)))
    best = std::prev(next);
  if (best == stamps_.end() || off(*best) > tolerance_s_) return nullptr;
  asked_ = *best;
  while (!scan_ || scan_->stamp < asked_) {
    scan_ = feed_.next();
    if (!scan_) return nullptr;
  }
  return scan_->stamp == asked_ ? &*scan_ : nullptr;
}

}  // namespace lidar_upsampling
