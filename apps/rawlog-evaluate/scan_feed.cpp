// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scan_feed.h"

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling {

ScanFeed::ScanFeed(const LogFile& log, std::function<bool(const std::string&, Stamp)> wanted)
    : reader_(log, RecordBytes::dropped), wanted_(std::move(wanted)) {}

std::optional<LidarScan> ScanFeed::next() {
  const auto take = [this](mrpt::obs::CObservation& observation) {
    if (!is_lidar_scan(observation) || !wanted_(observation.sensorLabel, observation.timestamp))
      return;
    if (auto scan = usable_.scan(observation)) waiting_.push_back(std::move(*scan));
  };
  const ExternalStorageGuard storage;  // of the densified log, whose turn it is
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

ReferenceScans::ReferenceScans(const LogFile& log, const std::string& label,
                               std::vector<Stamp> stamps, const std::vector<Stamp>& kept,
                               double tolerance_s, StraightScans straight)
    : stamps_(std::move(stamps)),
      kept_(kept),
      tolerance_s_(tolerance_s),
      feed_(log, [this, label](const std::string& of_scan,
                               Stamp stamp) { return of_scan == label && stamp >= asked_; }),
      straight_(std::move(straight)) {
  std::sort(stamps_.begin(), stamps_.end());
  std::sort(kept_.begin(), kept_.end());
  none_withheld_ = std::all_of(stamps_.begin(), stamps_.end(), [this](Stamp stamp) {
    return std::binary_search(kept_.begin(), kept_.end(), stamp);
  });
}

bool ReferenceScans::is_withheld(Stamp stamp) const {
  return none_withheld_ || !std::binary_search(kept_.begin(), kept_.end(), stamp);
}

std::optional<ScansAround> ReferenceScans::around(Stamp stamp, Stamp key) {
  const auto after = std::lower_bound(stamps_.begin(), stamps_.end(), stamp);
  const bool at_scan = after != stamps_.end() && *after == stamp;
  std::optional<Stamp> before, next, nearest;
  if (!at_scan && after != stamps_.begin() && *std::prev(after) > key) before = *std::prev(after);
  if (after != stamps_.end()) next = *after;
  for (const auto& candidate : {before, next}) {
    if (!candidate || !is_withheld(*candidate)) continue;
    const auto off = [&](Stamp other) { return std::abs(seconds_between(other, stamp)); };
    if (off(*candidate) <= tolerance_s_ && (!nearest || off(*candidate) < off(*nearest)))
      nearest = candidate;
  }
  if (!nearest) return {};
  ScansAround around;
  if (before) around.before = scan_at(*before);
  if (next) around.after = scan_at(*next);
  around.nearest = nearest == before ? around.before : around.after;
  if (around.nearest == nullptr) return {};
  return around;
}

const LidarScan* ReferenceScans::scan_at(Stamp stamp) {
  const auto known = std::find_if(scans_.begin(), scans_.end(),
                                  [stamp](const LidarScan& scan) { return scan.stamp == stamp; });
  if (known != scans_.end()) return &*known;
  if (!scans_.empty() && scans_.back().stamp > stamp) return nullptr;  // none that can be used
  asked_ = stamp;
  while (auto scan = feed_.next()) {
    scans_.push_back(straight_.straight(std::move(*scan)));
    // Pointers to the others stay good.
    if (scans_.size() > 3) scans_.pop_front();
    if (scans_.back().stamp >= stamp) break;
  }
  if (!scans_.empty() && scans_.back().stamp == stamp) return &scans_.back();
  return nullptr;
}

}  // namespace lidar_upsampling
