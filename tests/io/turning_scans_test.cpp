// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/turning_scans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lidar_upsampling {
namespace {

constexpr int kRings = 16, kColumns = 900;

/// 16 lasers, each at an azimuth of its own, that miss a tenth of what they should see.
LidarScan turned(double sense, bool by_ring) {
  LidarScan scan;
  scan.num_rings = kRings;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto measure = [&](int ring, int column) {
    if (unit(random) < 0.1) return;
    const double offset = 0.3 * std::sin(ring), range = 3 + 50 * unit(random);
    const double azimuth = 0.1 + sense * 2 * M_PI * (column + offset) / kColumns;
    const double slope = 0.03 * (ring - 10);
    scan.points.push_back(
        (range * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), slope)).cast<float>());
    scan.ring.push_back(static_cast<std::uint16_t>(ring));
    scan.column.push_back(static_cast<std::uint16_t>(column));
    scan.time_s.push_back(0.1F * static_cast<float>(column) / kColumns);
  };
  if (by_ring)
    for (int ring = 0; ring < kRings; ++ring)
      for (int column = 0; column < kColumns; ++column) measure(ring, column);
  else
    for (int column = 0; column < kColumns; ++column)
      for (int ring = 0; ring < kRings; ++ring) measure(ring, column);
  return scan;
}

/// Columns count from another azimuth, but as the sensor's own do.
void expect_same_but_for_the_first(const LidarScan& found, const LidarScan& scan) {
  ASSERT_EQ(found.num_columns, kColumns);
  ASSERT_EQ(found.column.size(), scan.size());
  int num_other = 0;
  std::vector<int> shift(kRings, -1);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const int now = (found.column[i] - scan.column[i] + kColumns) % kColumns;
    int& first = shift[scan.ring[i]];
    if (first < 0) first = now;
    num_other += now != first ? 1 : 0;
  }
  EXPECT_EQ(num_other, 0);
}

TEST(TurningScans, columns_are_found_from_azimuths_whichever_way_it_turns) {
  for (const double sense : {1., -1.})
    for (const bool by_ring : {false, true}) {
      const LidarScan scan = turned(sense, by_ring);
      LidarScan found = scan;
      found.column.clear();
      found.time_s.clear();
      find_columns(found);
      expect_same_but_for_the_first(found, scan);
    }
}

TEST(TurningScans, times_tell_the_order_where_the_points_have_another) {
  LidarScan scan = turned(-1, false);
  LidarScan found = scan;
  std::reverse(found.points.begin(), found.points.end());
  std::reverse(found.ring.begin(), found.ring.end());
  std::reverse(found.time_s.begin(), found.time_s.end());
  found.column.clear();
  find_columns(found);
  std::reverse(found.column.begin(), found.column.end());
  expect_same_but_for_the_first(found, scan);
}

TEST(TurningScans, points_in_no_order_get_no_columns) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> coordinate(-20, 20);
  LidarScan scan;
  scan.num_rings = 4;
  for (int i = 0; i < 2000; ++i) {
    scan.points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    scan.ring.push_back(static_cast<std::uint16_t>(i % 4));
  }
  find_columns(scan);
  EXPECT_TRUE(scan.column.empty());
  EXPECT_EQ(scan.num_columns, 0);
}

TEST(TurningScans, rings_are_counted_from_the_lowest_beam) {
  const LidarScan scan = turned(1, false);
  LidarScan same = scan, down = scan;
  number_rings_upwards(same);
  EXPECT_EQ(same.ring, scan.ring);
  for (auto& ring : down.ring) ring = static_cast<std::uint16_t>(kRings - 1 - ring);
  number_rings_upwards(down);
  EXPECT_EQ(down.ring, scan.ring);
}

TEST(TurningScans, a_single_ring_keeps_its_number) {
  LidarScan scan;
  scan.num_rings = 6;
  scan.points = {{1, 0, 0.1F}, {0, 1, 0.3F}, {-1, 0, 0.2F}};
  scan.ring.assign(3, 5);
  number_rings_upwards(scan);
  EXPECT_EQ(scan.ring, (std::vector<std::uint16_t>{5, 5, 5}));
}

}  // namespace
}  // namespace lidar_upsampling
