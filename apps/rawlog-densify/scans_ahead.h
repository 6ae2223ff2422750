// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/rig_overrides.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief The scans of a log a little before the log's own turn: what a run that is not live may
/// know. Those that cannot be used are passed over.
class ScansAhead {
 public:
  /// @param rig, sweep must outlive this.
  ScansAhead(std::string lidar_label, const RigOverrides& rig, const SweepOptions& sweep)
      : lidar_label_(std::move(lidar_label)), usable_(rig, sweep) {}

  /// An entry of the log, ahead of its turn.
  void add(const RawlogEntry& entry);
  /// @return the next scan, none if no entry with one has been added.
  [[nodiscard]] std::optional<LidarScan> next();
  /// Scans that next() has not given yet.
  [[nodiscard]] std::size_t size() const { return read_.size(); }

 private:
  void add_observation(const mrpt::obs::CObservation& observation);

  std::string lidar_label_;
  UsableObservations usable_;  ///< what is not is told when its own turn comes
  std::deque<LidarScan> read_;
};

}  // namespace lidar_upsampling
