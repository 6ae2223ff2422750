// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/types.h"
#include "straight_scans.h"

namespace lidar_upsampling {

/// @brief The usable scans of a log that are asked for, one after the other, whether they stand
/// alone or in sensory frames.
class ScanFeed {
 public:
  /// @param wanted by label and stamp; only wanted scans are decoded.
  ScanFeed(const LogFile& log, std::function<bool(const std::string&, Stamp)> wanted);

  /// @return the next scan, none at the end. @throw CorruptRawlog, std::runtime_error
  [[nodiscard]] std::optional<LidarScan> next();

 private:
  RawlogReader reader_;
  std::function<bool(const std::string&, Stamp)> wanted_;
  UsableObservations usable_;
  std::deque<LidarScan> waiting_;  // of the same sensory frame
};

/// The real scans about an instant.
struct ScansAround {
  const LidarScan* before =
      nullptr;  ///< the last one at or before it; null if it is not after the key scan
  const LidarScan* after = nullptr;    ///< the first one at or after it
  const LidarScan* nearest = nullptr;  ///< the withheld one of them that lies nearer
};

/// @brief The scans of a log about instants that are asked for in ascending order.
class ReferenceScans {
 public:
  /// @param stamps of the label's scans in the log.
  /// @param kept stamps of the scans that the densified log still holds; where all are kept, each
  /// counts as withheld.
  /// @param straight of this log's scans.
  ReferenceScans(const LogFile& log, const std::string& label, std::vector<Stamp> stamps,
                 const std::vector<Stamp>& kept, double tolerance_s, StraightScans straight);

  ReferenceScans(const ReferenceScans&) = delete;
  ReferenceScans& operator=(const ReferenceScans&) = delete;

  [[nodiscard]] bool none_withheld() const { return none_withheld_; }

  /// @param key the key scan's stamp: scans up to it tell nothing.
  /// @return none without a withheld scan within the tolerance. Good until the next call.
  [[nodiscard]] std::optional<ScansAround> around(Stamp stamp, Stamp key);

 private:
  [[nodiscard]] const LidarScan* scan_at(Stamp stamp);
  [[nodiscard]] bool is_withheld(Stamp stamp) const;

  std::vector<Stamp> stamps_, kept_;
  bool none_withheld_ = false;
  double tolerance_s_;
  Stamp asked_;
  ScanFeed feed_;
  StraightScans straight_;
  std::deque<LidarScan> scans_;  // the last ones read
};

}  // namespace lidar_upsampling
