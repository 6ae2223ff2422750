// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "depth_observation.h"

#include <cmath>

#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling::sim {

mrpt::obs::CObservation3DRangeScan::Ptr depth_observation(const LidarScan& scan,
                                                          const LidarSpec& spec) {
  const CameraModel& model = spec.depth_camera.value();
  auto observation = mrpt::obs::CObservation3DRangeScan::Create();
  observation->timestamp = scan.stamp;
  observation->sensorLabel = scan.label;
  observation->sensorPose = to_mrpt(scan.T_vehicle_lidar);
  observation->cameraParams = to_mrpt(model);
  observation->cameraParamsIntensity = observation->cameraParams;
  observation->maxRange = static_cast<float>(spec.max_range_m);
  observation->stdError = static_cast<float>(spec.noise_m);
  observation->rangeUnits = 0.001F;
  observation->range_is_depth = true;
  observation->hasRangeImage = true;
  observation->rangeImage_setSize(model.height, model.width);
  observation->rangeImage.fill(0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const int row = model.height - 1 - scan.ring[i];
    observation->rangeImage(row, scan.column[i]) =
        static_cast<std::uint16_t>(std::lround(1000 * scan.points[i].x()));
  }
  return observation;
}

}  // namespace lidar_upsampling::sim
