// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "path_errors.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "known_scans.h"
#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/reading_guard.h"
#include "lidar_upsampling/io/unpacker.h"
#include "lidar_upsampling/units.h"
#include "lidar_upsampling/virtual_label.h"

namespace lidar_upsampling::maps {
namespace {

double yaw_of(const Pose& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

/// The first scan of a frame of the map, where it holds one.
mrpt::obs::CObservation::Ptr scan_of(const mrpt::obs::CSensoryFrame& frame) {
  for (const auto& observation : frame)
    if (is_lidar_scan(*observation)) return observation;
  return nullptr;
}

mrpt::maps::CSimpleMap map_in(const std::string& path) {
  const ReadingGuard guard([&] { return unpacked_size_of(path); });
  mrpt::maps::CSimpleMap map;
  if (!map.loadFromFile(path)) throw std::runtime_error(path + ": cannot read this simplemap");
  return map;
}

}  // namespace

PathErrors errors_of_path(const std::string& path, const Trajectory& T_world_vehicle) {
  mrpt::maps::CSimpleMap map = map_in(path);
  PathErrors errors;
  std::optional<Pose> T_world_map;
  Eigen::Vector3d last_place = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < map.size(); ++i) {
    const compat::Keyframe keyframe = compat::keyframe_of(map, i);
    const auto scan = scan_of(*keyframe.frame);
    if (!scan) continue;
    ++(is_virtual_label(scan->sensorLabel) ? errors.num_virtual : errors.num_real);
    const auto truth = T_world_vehicle.at(scan->timestamp);
    if (is_virtual_label(scan->sensorLabel)) continue;
    if (!truth) {
      ++errors.num_beyond;
      continue;
    }
    const Pose T_map_vehicle = from_mrpt(keyframe.pose->getMeanVal());
    const Eigen::Vector3d place = truth->T_world_vehicle.translation();
    if (!T_world_map) {
      T_world_map = truth->T_world_vehicle * T_map_vehicle.inverse();
      last_place = place;
    }
    const Pose estimate = *T_world_map * T_map_vehicle;
    errors.last_m = (estimate.translation() - place).head<2>().norm();
    errors.last_yaw_deg =
        std::abs(std::remainder(yaw_of(estimate) - yaw_of(truth->T_world_vehicle), 2 * M_PI)) /
        kDegree;
    errors.mean_m += errors.last_m;
    errors.length_m += (place - last_place).norm();
    last_place = place;
  }
  if (errors.num_real == 0) throw std::runtime_error(path + ": holds no real scan");
  const int num_compared = errors.num_real - errors.num_beyond;
  if (num_compared < errors.num_beyond || num_compared == 0)
    throw std::runtime_error(
        path + ": the reference tells the true places of " + std::to_string(num_compared) +
        " of its " + std::to_string(errors.num_real) + " real scans; is it of another time?");
  errors.mean_m /= num_compared;
  return errors;
}

}  // namespace lidar_upsampling::maps
