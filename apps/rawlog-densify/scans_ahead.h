// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/rig_overrides.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Reads the scans of a log a little before the log's own turn: what a run that is not live
/// may know. Unreadable ones are passed over; a broken end of the log is its end.
class ScansAhead {
 public:
  /// @throw std::runtime_error the file cannot be opened.
  ScansAhead(const std::string& path, std::string lidar_label, const RigOverrides& rig)
      : reader_(path), lidar_label_(std::move(lidar_label)), rig_(rig) {}

  /// @return the next scan, none at the end of the log.
  [[nodiscard]] std::optional<LidarScan> next();

 private:
  void read_on();

  RawlogReader reader_;
  std::string lidar_label_;
  const RigOverrides& rig_;
  std::deque<LidarScan> read_;
  bool at_end_ = false;
};

}  // namespace lidar_upsampling
