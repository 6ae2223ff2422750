// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/correspondence.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

void look_up(const Surface& surface, const Eigen::Vector3f& place, float reach_m,
             Correspondence& correspondence) {
  constexpr float kRounding_m = 1e-5F;
  constexpr float kBeyond_m = 0.1F;  // the farther is looked, the longer it holds
  float farthest_m = reach_m;
  if (correspondence.index >= 0) {
    const float last_m = (surface.points()[correspondence.index] - place).norm();
    const float moved_m = (place - correspondence.asked).norm();
    if (last_m + moved_m + kRounding_m < correspondence.others_m) {
      if (last_m >= reach_m) correspondence.index = -1;
      return;
    }
    farthest_m = std::min(reach_m, last_m + kBeyond_m);
  }
  const auto nearest = surface.nearest_of_all(place, farthest_m * farthest_m);
  correspondence = {nearest.first.index, place, std::sqrt(nearest.sq_others)};
}

}  // namespace lidar_upsampling
