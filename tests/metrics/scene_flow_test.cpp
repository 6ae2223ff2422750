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
  EXPECT_EQ(epe.num_background_static, 97);
  EXPECT_EQ(epe.num_foreground_dynamic, 2);
  EXPECT_EQ(epe.num_foreground_static, 1);
}

TEST(ThreeWayEpe, leaves_out_a_class_without_points_and_says_so) {
  const ThreeWayEpe epe = three_way_epe(
      {flow(0.2, 0, FlowClass::background_static), flow(0.4, 0, FlowClass::foreground_static)});
  EXPECT_FALSE(epe.foreground_dynamic);
  EXPECT_EQ(epe.num_foreground_dynamic, 0);
  EXPECT_NEAR(epe.mean().value(), 0.3, 1e-12);
  EXPECT_FALSE(three_way_epe({}).mean());
}

TEST(BucketedEpe, weighs_slow_and_fast_alike) {
  std::vector<PointFlow> flows;
  // At 1 m/s 10 % off, at 10 m/s 30 % off and many more of them, standing 1 cm off.
  flows.push_back(flow(0.11, 0.1, FlowClass::foreground_dynamic));
  flows.insert(flows.end(), 50, flow(0.7, 1.0, FlowClass::foreground_dynamic));
  flows.push_back(flow(0.01, 0, FlowClass::foreground_static));
  const BucketedEpe epe = bucketed_epe(flows, 0.1);
  EXPECT_NEAR(epe.dynamic_normalized.value(), 0.2, 1e-9);
  EXPECT_EQ(epe.num_dynamic_buckets, 2);
  EXPECT_NEAR(epe.static_m.value(), 0.01, 1e-12);
}

TEST(BucketedEpe, of_saying_that_everything_stands_is_one) {
  std::vector<PointFlow> flows;
  for (int i = 1; i < 60; ++i) {
    flows.push_back(flow(0, 0.09 * i, FlowClass::foreground_dynamic));
  }
  const BucketedEpe epe = bucketed_epe(flows, 0.1);
  EXPECT_NEAR(epe.dynamic_normalized.value(), 1, 1e-12);
  EXPECT_FALSE(epe.static_m);
}

TEST(BucketedEpe, puts_all_above_the_last_edge_in_one_bucket) {
  const BucketedEpe epe = bucketed_epe({flow(2.5, 2.0, FlowClass::foreground_dynamic),
                                        flow(5.5, 6.0, FlowClass::foreground_dynamic)},
                                       0.1, {1, 20});
  EXPECT_EQ(epe.num_dynamic_buckets, 1);
  EXPECT_NEAR(epe.dynamic_normalized.value(), 1. / 8, 1e-12);
}

TEST(BucketedEpe, refuses_times_and_widths_that_are_not_positive) {
  EXPECT_THROW(static_cast<void>(bucketed_epe({}, 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(bucketed_epe({}, 0.1, {0, 20})), std::invalid_argument);
  EXPECT_FALSE(bucketed_epe({}, 0.1).dynamic_normalized);
}

}  // namespace
}  // namespace lidar_upsampling
