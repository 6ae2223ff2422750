// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/front_end/virtual_observations.h"

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/scene/object_scene.h"

namespace lidar_upsampling {

std::vector<mrpt::obs::CObservation::Ptr> virtual_observations(
    const VirtualScan& scan, const Config& config, const mrpt::obs::CObservation& real) {
  std::vector<mrpt::obs::CObservation::Ptr> all{
      observation_from_scan(scan.scan, carrier_from_string(config.carrier), &real)};
  if (config.annotate != 0)
    all.push_back(observation_of_objects(scan, real.sensorLabel + "_OBJECTS"));
  return all;
}

}  // namespace lidar_upsampling
