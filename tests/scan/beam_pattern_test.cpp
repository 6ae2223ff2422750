// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/beam_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "lidar_upsampling/scan/beams.h"
#include "spinning_scene.h"

namespace lidar_upsampling {
namespace {

using namespace testing;

const Block kWall{{14, -30, -2}, {15, 30, 6}};
const Block kNearWall{{-5, -30, -2}, {-4, 30, 6}};

TEST(BeamPattern, tells_the_elevation_and_the_height_of_each_laser) {
  Spinner spinner;
  spinner.upper_half_raised_m = 0.2;
  spinner.noise_m = 0.02;
  const auto pattern = find_beam_pattern(scan_of({kWall, kNearWall}, spinner).scan);
  ASSERT_TRUE(pattern);
  ASSERT_EQ(pattern->num_rows(), 64);
  for (const int ring : {16, 40, 63}) {
    const Eigen::Vector3d beam = spinner.direction(ring, 0);
    EXPECT_NEAR(pattern->rows[ring].tan_elevation, beam.z() / beam.head<2>().norm(), 2e-4);
    EXPECT_NEAR(pattern->rows[ring].origin_height, spinner.origin(ring).z(), 5e-3);
  }
  EXPECT_NEAR(pattern->azimuth_pitch, 2 * M_PI / spinner.columns, 1e-5);
}

TEST(BeamPattern, does_not_depend_on_the_order_of_points_or_the_numbers_of_rings) {
  const LidarScan scan = scan_of({kWall}, {}).scan;
  std::vector<int> shuffled(scan.size());
  std::iota(shuffled.begin(), shuffled.end(), 0);
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
  LidarScan other;
  for (const int i : shuffled) {
    other.points.push_back(scan.points[i]);
    other.ring.push_back(static_cast<std::uint16_t>(63 - scan.ring[i]));
  }
  const auto pattern = find_beam_pattern(scan), other_pattern = find_beam_pattern(other);
  ASSERT_TRUE(pattern && other_pattern);
  ASSERT_EQ(pattern->order.size(), other_pattern->order.size());
  for (std::size_t k = 0; k < pattern->order.size(); ++k)
    ASSERT_EQ(pattern->order[k], shuffled[other_pattern->order[k]]);
}

TEST(BeamPattern, is_none_of_a_scan_without_rings_or_of_a_depth_picture) {
  LidarScan scan = scan_of({kWall}, {}).scan;
  scan.ring.clear();
  EXPECT_FALSE(find_beam_pattern(scan));

  LidarScan picture;
  for (int row = 0; row < 240; ++row)
    for (int column = 0; column < 320; ++column) {
      picture.points.emplace_back(3, (160 - column) * 0.01F, (row - 120) * 0.01F);
      picture.ring.push_back(static_cast<std::uint16_t>(row));
      picture.column.push_back(static_cast<std::uint16_t>(column));
    }
  EXPECT_FALSE(find_beam_pattern(picture));
  EXPECT_FALSE(find_beam_pattern({}));
}

TEST(BeamPattern, the_rows_of_a_narrow_depth_camera_are_no_beams) {
  // So narrow that its rows hardly differ from cones.
  constexpr float kFocal = 400;
  LidarScan picture;
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 160; ++column) {
      const float depth = column < 70 ? 3.F : 8.F;
      picture.points.emplace_back(depth, depth * static_cast<float>(80 - column) / kFocal,
                                  depth * static_cast<float>(row - 50) / kFocal);
      picture.ring.push_back(static_cast<std::uint16_t>(row));
    }
  EXPECT_FALSE(find_beam_pattern(picture));
}

TEST(BeamPattern, neighbours_go_round_and_not_across_gaps) {
  LabelledScan key = scan_of({}, {});
  const auto pattern = find_beam_pattern(key.scan);
  ASSERT_TRUE(pattern);
  std::vector<BeamNeighbours> neighbours(key.scan.size());
  find_neighbours(*pattern, 5, neighbours);
  const auto column = [&](int k) { return key.scan.column[pattern->order[k]]; };
  const auto ring = [&](int k) { return key.scan.ring[pattern->order[k]]; };
  for (int k = pattern->rows[5].begin; k < pattern->rows[5].end; ++k) {
    ASSERT_EQ(column(neighbours[k][kLeft]), (column(k) + 1799) % 1800);
    ASSERT_EQ(column(neighbours[k][kRight]), (column(k) + 1) % 1800);
    ASSERT_EQ(column(neighbours[k][kUp]), column(k));
    ASSERT_EQ(ring(neighbours[k][kUp]), 6);
    ASSERT_EQ(ring(neighbours[k][kDown]), 4);
  }
}

TEST(Beams, fill_the_gaps_of_a_row_on_its_own_steps) {
  // The upper rings meet nothing but the wall.
  const Spinner spinner;
  const LidarScan scan = scan_of({kWall}, spinner).scan;
  const auto pattern = find_beam_pattern(scan);
  ASSERT_TRUE(pattern);
  const bool to_left = columns_go_left(scan, *pattern);
  EXPECT_FALSE(to_left);
  const int ring = 62;
  const std::vector<Beam> beams = find_beams(scan, *pattern, ring, seen_directions(*pattern));
  ASSERT_EQ(beams.size(), 1800U);
  int in_gaps = 0;
  for (const Beam& beam : beams) {
    const BeamLabel label = label_of(beam, scan, to_left);
    in_gaps += beam.point < 0 ? 1 : 0;
    ASSERT_EQ(label.ring, ring);
    ASSERT_LT((beam.direction - spinner.direction(ring, label.column).cast<float>()).norm(), 1e-4);
  }
  EXPECT_GT(in_gaps, 900);
}

TEST(Beams, leave_out_directions_in_which_the_sensor_sees_nothing_at_all) {
  const LidarScan all = scan_of({kWall}, {}).scan;
  LidarScan front;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all.points[i].x() > std::abs(all.points[i].y())) {
      front.points.push_back(all.points[i]);
      front.ring.push_back(all.ring[i]);
    }
  const auto pattern = find_beam_pattern(front);
  ASSERT_TRUE(pattern);
  for (const Beam& beam : find_beams(front, *pattern, 10, seen_directions(*pattern)))
    ASSERT_GT(beam.direction.x(), std::abs(beam.direction.y()) - 0.02);
}

}  // namespace
}  // namespace lidar_upsampling
