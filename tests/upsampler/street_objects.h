// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "street_run.h"

namespace lidar_upsampling {

inline std::vector<const ObjectMotion*> moving_objects(const VirtualScan& scan) {
  std::vector<const ObjectMotion*> moving;
  for (const ObjectMotion& object : scan.objects)
    if (object.status == MotionStatus::moving) moving.push_back(&object);
  return moving;
}

inline Stamp street_begin() { return sim::stamps_of(10, 0, 0.01).front(); }

/// The world object that moves so fast along the street.
inline int car_at_velocity(const StreetRun& street, double v) {
  constexpr double kWithin = 0.5;
  for (int i = 0; i < static_cast<int>(street.world.objects.size()); ++i) {
    if (!street.world.objects[i].moves()) continue;
    const Eigen::Vector3d then = street.world.T_world_object(i, 0.1).translation();
    const double here = (then - street.world.T_world_object(i, 0).translation()).x() / 0.1;
    if (std::abs(here - v) < kWithin) return i;
  }
  return -1;
}

/// What is told of the object that most of a world object's points belong to; null: nothing.
inline const ObjectMotion* motion_of(const StreetRun& street, const VirtualScan& scan, int object) {
  const std::vector<int> owner = street.scan_at(scan.key_stamp).object;
  const auto told =
      std::find_if(scan.objects.begin(), scan.objects.end(), [&](const ObjectMotion& motion) {
        const auto own = std::count_if(motion.points.begin(), motion.points.end(),
                                       [&](int i) { return owner[i] == object; });
        return own > 0.5 * static_cast<double>(std::count(owner.begin(), owner.end(), object));
      });
  return told == scan.objects.end() ? nullptr : &*told;
}

}  // namespace lidar_upsampling
