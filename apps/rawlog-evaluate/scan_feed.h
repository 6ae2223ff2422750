// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief The scans of a log that are asked for, one after the other, whether they stand alone or
/// in sensory frames.
class ScanFeed {
 public:
  /// @param wanted by label and stamp; only wanted scans are decoded.
  ScanFeed(const std::string& path, std::function<bool(const std::string&, Stamp)> wanted);

  /// @return the next scan, none at the end. @throw CorruptRawlog, std::runtime_error
  [[nodiscard]] std::optional<LidarScan> next();
  [[nodiscard]] double progress() const { return reader_.progress(); }

 private:
  RawlogReader reader_;
  std::function<bool(const std::string&, Stamp)> wanted_;
  std::deque<LidarScan> waiting_;  // of the same sensory frame
};

/// @brief The scan of a log that lies nearest to a stamp; stamps are asked for in ascending order.
class ReferenceScans {
 public:
  /// @param stamps of the label's scans in the log.
  ReferenceScans(const std::string& path, const std::string& label, std::vector<Stamp> stamps,
                 double tolerance_s);

  ReferenceScans(const ReferenceScans&) = delete;
  ReferenceScans& operator=(const ReferenceScans&) = delete;

  /// @return none if there is none within the tolerance.
  [[nodiscard]] const LidarScan* nearest(Stamp stamp);

 private:
  std::vector<Stamp> stamps_;
  double tolerance_s_;
  Stamp asked_;
  ScanFeed feed_;
  std::optional<LidarScan> scan_;
};

}  // namespace lidar_upsampling
