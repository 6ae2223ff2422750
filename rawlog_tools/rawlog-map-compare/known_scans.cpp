// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "known_scans.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <optional>
#include <stdexcept>

#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/virtual_label.h"

namespace lidar_upsampling::maps {
namespace {

// Scans of 5 Hz are joined; past the ends, a picture's distance from its scan.
constexpr InterpolationLimits kLimits{0.6, 0.1};

Trajectory joined(const std::vector<PoseSample>& samples) {
  Trajectory trajectory(kLimits);
  for (const PoseSample& sample : samples) trajectory.add(sample);
  return trajectory;
}

Trajectory registered(const LogFile& log) {
  Trajectory trajectory(kLimits);
  std::optional<LidarScan> previous;
  Pose T_world_lidar = Pose::Identity(), step = Pose::Identity();
  for_each_scan(log, [&](const LidarScan& scan) {
    if (is_virtual_label(scan.label)) return;
    if (previous) {
      const auto found = register_scans(scan.points, previous->points, step);
      if (!found)
        throw std::runtime_error(log.path + ": has no poses, and the scan at " +
                                 to_text(scan.stamp) + " cannot be registered to the one before");
      step = found->T_target_source;
      T_world_lidar = T_world_lidar * step;
    }
    trajectory.add({scan.stamp, T_world_lidar * scan.T_vehicle_lidar.inverse()});
    previous = scan;
  });
  if (trajectory.size() < 2)
    throw std::runtime_error(log.path +
                             ": has neither poses nor two real scans: no way to map along");
  return trajectory;
}

}  // namespace

std::vector<std::string> for_each_scan(const LogFile& log,
                                       const std::function<void(const LidarScan&)>& use) {
  UnusedCounts unused;
  UsableObservations usable(counted_in(unused));
  const auto use_scan = [&](mrpt::obs::CObservation& observation) {
    if (!is_lidar_scan(observation)) return;
    if (const auto scan = usable.scan(observation)) use(*scan);
  };
  RawlogReader reader(log, RecordBytes::dropped);
  while (const auto entry = reader.next()) {
    if (auto* const frame = dynamic_cast<mrpt::obs::CSensoryFrame*>(entry->object.get())) {
      for (const auto& observation : *frame) use_scan(*observation);
    } else if (auto* const one = dynamic_cast<mrpt::obs::CObservation*>(entry->object.get())) {
      use_scan(*one);
    }
  }
  std::vector<std::string> warnings;
  for (const auto& count : unused) warnings.push_back(to_text(count));
  if (reader.damage()) warnings.push_back(*reader.damage());
  return warnings;
}

Trajectory trajectory_of(const LogFile& log) {
  const LogIndex index = index_log(log);
  if (index.poses.size() >= 2) return joined(index.poses);
  if (index.odometry.size() >= 2) return joined(index.odometry);
  return registered(log);
}

}  // namespace lidar_upsampling::maps
