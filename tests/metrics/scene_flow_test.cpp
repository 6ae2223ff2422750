// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/scene_flow.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

PointFlow flow(double estimated_x, double true_x, FlowClass kind) {
  return {{estimated_x, 0, 0}, {true_x, 0, 0}, kind};
}

TEST(ThreeWayEpe, counts_each_class_the_same_however_many_points_it_has) {
  std::vector<PointFlow> flows(97, flow(0, 0.1, FlowClass::background_static));
  flows.push_back(flow(1, 0.5, FlowClass::foreground_dynamic));
  flows.push_back({{0.3, 0.4, 0}, {0, 0, 0}, FlowClass::foreground_dynamic});
  flows.push_back(flow(0.9, 0, FlowClass::foreground_static));
  const ThreeWayEpe epe = three_way_epe(flows);
  EXPECT_NEAR(epe.background_static.value(), 0.1, 1e-12);
  EXPECT_NEAR(epe.foreground_dynamic.value(), 0.5, 1e-12);
  EXPECT_NEAR(epe.foreground_static.value(), 0.9, 1e-12);
  EXPECT_NEAR(epe.mean().value(), 0.5, 1e-12);
}

TEST(ThreeWayEpe, leaves_out_a_class_without_points_and_says_so) {
  const ThreeWayEpe epe = three_way_epe(
      {flow(0.2, 0, FlowClass::background_static), flow(0.4, 0, FlowClass::foreground_static)});
  EXPECT_FALSE(epe.foreground_dynamic);
  EXPECT_NEAR(epe.mean().value(), 0.3, 1e-12);
  EXPECT_FALSE(three_way_epe({}).mean());
}

}  // namespace
}  // namespace lidar_upsampling
