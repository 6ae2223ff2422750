// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "straight_scans.h"

#include <utility>

#include "lidar_upsampling/registration/scan_registration.h"

namespace lidar_upsampling {

StraightScans::StraightScans(const SweepOptions& sweep, const std::vector<Stamp>& stamps,
                             const Truth* truth)
    : sweep_(sweep), turn_s_(turn_s(sweep, stamps)), truth_(truth) {}

void StraightScans::straighten(LidarScan& scan, const std::vector<float>& times) const {
  deskew(scan, times, [&](double time) -> Pose {
    if (truth_ != nullptr)
      if (const auto T_then_now = true_ego_motion(*truth_, scan, shifted(scan.stamp, time)))
        return T_then_now->inverse();
    return exp_se3(Twist(-time * rate_));
  });
}

bool StraightScans::learn_rate(const LidarScan& before, const LidarScan& scan) {
  const double dt = seconds_between(before.stamp, scan.stamp);
  if (!(dt > 0)) return false;
  const auto found = register_scans(scan.points, before.points, exp_se3(Twist(-dt * rate_)));
  if (found) rate_ = -log_se3(found->T_target_source) / dt;
  return found.has_value();
}

void StraightScans::start_with(const LidarScan& first, const LidarScan& second) {
  if (truth_ == nullptr && !point_times(first, sweep_, turn_s_).empty()) learn_rate(first, second);
}

LidarScan StraightScans::straight(LidarScan scan) {
  drop_points_without_time(scan, sweep_);
  const std::vector<float> times = point_times(scan, sweep_, turn_s_);
  if (times.empty()) return scan;
  const std::vector<Eigen::Vector3f> as_measured = scan.points;
  straighten(scan, times);
  if (truth_ != nullptr) return scan;
  if (before_ && learn_rate(*before_, scan)) {
    scan.points = as_measured;  // once more, by the rate that it showed itself
    straighten(scan, times);
  }
  before_ = scan;
  return scan;
}

}  // namespace lidar_upsampling
