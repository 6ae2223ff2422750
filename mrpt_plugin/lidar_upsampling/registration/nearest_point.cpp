// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/nearest_point.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

void look_up(const Surface& surface, const Eigen::Vector3f& place, float reach_m,
             NearestPoint& nearest_point) {
  constexpr float kRounding_m = 1e-5F;
  constexpr float kBeyond_m = 0.1F;  // the farther it looks, the longer that holds; of speed alone
  float farthest_m = reach_m;
  if (nearest_point.index >= 0) {
    const float last_m = (surface.points()[nearest_point.index] - place).norm();
    const float moved_m = (place - nearest_point.asked).norm();
    if (last_m + moved_m + kRounding_m < nearest_point.others_m) {
      if (last_m >= reach_m) nearest_point.index = -1;
      return;
    }
    farthest_m = std::min(reach_m, last_m + kBeyond_m);
  }
  const auto nearest = surface.nearest_of_all(place, farthest_m * farthest_m);
  nearest_point = {nearest.first.index, place, std::sqrt(nearest.sq_others)};
}

}  // namespace lidar_upsampling
