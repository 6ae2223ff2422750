// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

const char* to_string(MotionStatus status) {
  switch (status) {
    case MotionStatus::moving:
      return "moving";
    case MotionStatus::stationary:
      return "stationary";
    case MotionStatus::predicted:
      return "predicted";
    case MotionStatus::too_few_points:
      return "too_few_points";
    case MotionStatus::no_consensus:
      return "no_consensus";
  }
  return "unknown";
}

}  // namespace lidar_upsampling
