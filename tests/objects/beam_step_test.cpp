// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/beam_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr int kRings = 16;
constexpr double kRing_deg = 2;

// Columns of `step_deg` each, of which the first looks ahead; a wall at 10 m all around.
LidarScan scan_of(int columns, double step_deg, bool by_column) {
  LidarScan scan;
  scan.num_rings = kRings;
  scan.num_columns = columns;
  const auto add = [&](int ring, int column) {
    const double azimuth = column * step_deg * kDegree, up = (ring - 8) * kRing_deg * kDegree;
    scan.points.push_back(
        10 * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), std::tan(up)).cast<float>());
    scan.ring.push_back(static_cast<std::uint16_t>(ring));
    scan.column.push_back(static_cast<std::uint16_t>(column));
  };
  for (int a = 0; a < (by_column ? columns : kRings); ++a)
    for (int b = 0; b < (by_column ? kRings : columns); ++b) by_column ? add(b, a) : add(a, b);
  return scan;
}

TEST(BeamStep, columns_of_a_turn_lie_as_far_apart_as_they_divide_it) {
  for (const bool by_column : {true, false}) {
    const auto step = estimate_horizontal_step_deg(scan_of(1800, 0.2, by_column));
    ASSERT_TRUE(step);
    EXPECT_NEAR(*step, 0.2, 1e-3);
  }
}

TEST(BeamStep, columns_of_a_narrow_view_do_not_go_around) {
  const auto step = estimate_horizontal_step_deg(scan_of(320, 0.18, false));
  ASSERT_TRUE(step);
  EXPECT_NEAR(*step, 0.18, 1e-3);
}

TEST(BeamStep, what_came_back_here_and_there_does_not_widen_it) {
  LidarScan scan = scan_of(1800, 0.2, true);
  LidarScan some = scan;
  some.points.clear();
  some.ring.clear();
  some.column.clear();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.column[i] % 5 == 0) continue;
    some.points.push_back(scan.points[i]);
    some.ring.push_back(scan.ring[i]);
    some.column.push_back(scan.column[i]);
  }
  const auto step = estimate_horizontal_step_deg(some);
  ASSERT_TRUE(step);
  EXPECT_NEAR(*step, 0.2, 1e-3);
}

TEST(BeamStep, without_columns_there_is_none) {
  LidarScan scan = scan_of(100, 0.2, true);
  scan.column.clear();
  EXPECT_FALSE(estimate_horizontal_step_deg(scan));
}

TEST(BeamStep, rings_lie_as_far_apart_as_their_elevations_say) {
  EXPECT_NEAR(estimate_vertical_step_deg(scan_of(600, 0.6, true)), kRing_deg, 1e-3);
}

}  // namespace
}  // namespace lidar_upsampling
