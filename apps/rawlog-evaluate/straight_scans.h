// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/scan/sweep.h"
#include "lidar_upsampling/types.h"
#include "truth.h"

namespace lidar_upsampling {

/// @brief A log's real scans as virtual ones are made from them: where the points have instants of
/// their own, brought to the scan's stamp by the true ego-motion or, without a truth, by the
/// registration to the scan before. Else as they are.
class StraightScans {
 public:
  /// @param sweep as the log was densified with. @param stamps of the log's scans, whose shortest
  /// gap is a turn where `sweep` tells none. @param truth null: none; must outlive this.
  StraightScans(const SweepOptions& sweep, const std::vector<Stamp>& stamps, const Truth* truth);

  /// Without a truth, the rate of the first scans: they need not be straight, being swept alike.
  void start_with(const LidarScan& first, const LidarScan& second);

  /// To be called in the scans' order. @throw std::runtime_error as point_times()
  [[nodiscard]] LidarScan straight(LidarScan scan);

 private:
  void straighten(LidarScan& scan, const std::vector<float>& times) const;
  bool learn_rate(const LidarScan& before, const LidarScan& scan);

  SweepOptions sweep_;
  double turn_s_ = 0;
  const Truth* truth_;
  Twist rate_ = Twist::Zero();  ///< per second, of T_later_earlier, of the last scans
  std::optional<LidarScan> before_;
};

}  // namespace lidar_upsampling
