// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/feet.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lidar_upsampling/objects/column_grid.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {

std::vector<std::uint8_t> find_feet(const std::vector<Eigen::Vector3f>& points, float low,
                                    float high, double vertical_step_deg, double gap_m) {
  constexpr float kLeast = 0.5F, kMost = 1.6F;  // gaps between rings, to the next one above: they
                                                // are not all alike, and sides lean
  constexpr float kSteep = 4;  // up per beside: sides lean less, what lies before a car is flatter
  constexpr float kSqueeze = 0.3F;  // of heights: neighbours above count, those beside hardly
  constexpr float kSide_m = 0.3F;   // of a column of the grid: of speed alone
  constexpr int kGrain = 512;       // points per task
  std::vector<std::uint8_t> is_foot(points.size(), 0);
  const auto step = static_cast<float>(vertical_step_deg * kDegree);
  const auto nearest = static_cast<float>(gap_m / step);
  std::vector<int> index;
  std::vector<Eigen::Vector3f> squeezed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i];
    const float range = p.head<2>().norm();
    if (range < nearest || p.z() < low || p.z() > high + kMost * step * range) continue;
    index.push_back(static_cast<int>(i));
    squeezed.emplace_back(p.x(), p.y(), kSqueeze * p.z());
  }
  if (squeezed.empty()) return is_foot;
  const ColumnGrid grid(squeezed, kSide_m);
  tbb::parallel_for(
      tbb::blocked_range<int>(0, static_cast<int>(squeezed.size()), kGrain), [&](const auto& part) {
        for (int place = part.begin(); place < part.end(); ++place) {
          const int foot = index[grid.point[place]];
          if (points[foot].z() > high) continue;
          const float gap = step * points[foot].head<2>().norm(), reach = kSqueeze * kMost * gap;
          grid.for_each_within(place, reach * reach, [&](int other, float) {
            const Eigen::Vector3f up = points[index[other]] - points[foot];
            if (up.z() > kLeast * gap && up.z() > kSteep * up.head<2>().norm()) is_foot[foot] = 1;
          });
        }
      });
  return is_foot;
}

}  // namespace lidar_upsampling
