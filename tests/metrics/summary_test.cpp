// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lidar_upsampling {
namespace {

TEST(ErrorSummary, gives_mean_median_quartiles_and_95_percent) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) {
    values.push_back(i);
  }
  const ErrorSummary summary = summarize(values);
  EXPECT_EQ(summary.count, 101);
  EXPECT_DOUBLE_EQ(summary.mean, 50);
  EXPECT_DOUBLE_EQ(summary.median, 50);
  EXPECT_DOUBLE_EQ(summary.p95, 95);
  EXPECT_DOUBLE_EQ(summary.q1, 25);
  EXPECT_DOUBLE_EQ(summary.q3, 75);
  EXPECT_EQ(summarize({}).count, 0);
}

TEST(ErrorSummary, interpolates_between_few_values) {
  const ErrorSummary summary = summarize({4, 1, 2, 8});
  EXPECT_DOUBLE_EQ(summary.median, 3);
  EXPECT_DOUBLE_EQ(summary.q1, 1.75);
  EXPECT_DOUBLE_EQ(summary.q3, 5);
  EXPECT_DOUBLE_EQ(summarize({7}).q3, 7);
}

TEST(BinErrors, sorts_by_key_and_keeps_empty_bins) {
  const auto bins = bin_errors({{0, 1}, {9.99, 3}, {10, 5}, {200, 7}, {-1, 100}}, range_edges());
  ASSERT_EQ(bins.size(), 5U);
  EXPECT_EQ(bins[0].errors.count, 2);
  EXPECT_DOUBLE_EQ(bins[0].errors.mean, 2);
  EXPECT_EQ(bins[1].from, 10);
  EXPECT_EQ(bins[1].to, 20);
  EXPECT_DOUBLE_EQ(bins[1].errors.mean, 5);
  EXPECT_EQ(bins[2].errors.count, 0);
  EXPECT_EQ(bins[3].errors.count, 0);
  EXPECT_EQ(bins[4].from, 50);
  EXPECT_DOUBLE_EQ(bins[4].errors.mean, 7);
}

TEST(BinErrors, has_half_decades_for_numbers_of_points) {
  const auto edges = point_count_edges();
  EXPECT_EQ(edges, (std::vector<double>{0, 10, 32, 100, 316, 1000, 3162, 10000,
                                        std::numeric_limits<double>::infinity()}));
}

TEST(BinErrors, passes_over_keys_outside_and_keys_that_are_no_number) {
  const auto bins = bin_errors({{std::nan(""), 1}, {2, 1}, {-3, 1}, {0.5, 4}}, {0, 1, 2});
  EXPECT_EQ(bins[0].errors.count, 1);
  EXPECT_EQ(bins[1].errors.count, 0);
}

}  // namespace
}  // namespace lidar_upsampling
