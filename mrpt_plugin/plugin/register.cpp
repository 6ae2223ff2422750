// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/core/initializer.h>

#include "plugin/upsampled_lidar_sensor.h"

MRPT_INITIALIZER(registerUpsampledLidarSensor) {
  lidar_upsampling::UpsampledLidarSensor::doRegister();
}
