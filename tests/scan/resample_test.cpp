// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/resample.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <stdexcept>

#include "spinning_scene.h"

namespace lidar_upsampling {
namespace {

using namespace testing;

const Block kFarWall{{20, -30, -2}, {21, 30, 6}};
const Block kPost{{9, 2, -2}, {9.5, 2.5, 2}};

class ResampleForRings : public ::testing::TestWithParam<int> {};

TEST_P(ResampleForRings, rings_on_the_ground_lie_where_the_moved_sensor_draws_them) {
  Spinner spinner;
  spinner.rings = GetParam();
  const Pose T_world_lidar_t = driven(0.8, 0.2, 3);
  const LabelledScan key = scan_of({}, spinner), truth = scan_of({}, spinner, T_world_lidar_t);
  const auto [result, status] = resample_on_beams(key.scan, moved_scan(key, T_world_lidar_t));
  ASSERT_EQ(status, Resampling::done);
  const auto true_point = by_beam(truth.scan);
  int compared = 0;
  for (std::size_t i = 0; i < result.scan.size(); ++i) {
    const Eigen::Vector3f& point = result.scan.points[i];
    const int expected = true_point.at({result.scan.ring[i], result.scan.column[i]});
    // A centimetre on the way; at grazing incidence that is also what single precision gives.
    ASSERT_LT((point - truth.scan.points[expected]).norm(), 0.01) << point.transpose();
    ++compared;
  }
  // Behind the sensor comes up ground that it never saw.
  EXPECT_GT(compared, 0.93 * static_cast<double>(truth.scan.size()));
}

INSTANTIATE_TEST_SUITE_P(Sensors, ResampleForRings, ::testing::Values(16, 32, 64, 128));

TEST(Resample, lasers_apart_from_each_other_see_what_each_of_them_sees) {
  Spinner spinner;
  spinner.upper_half_raised_m = 0.25;
  const Pose T_world_lidar_t = driven(0.6, 0, 0);
  // Seen from one point, the fence would hide the wall from lasers that look over it.
  const Block fence{{3, -2, -2}, {3.3, 2, 0.1}};
  const std::vector<Block> blocks{kFarWall, fence};
  const LabelledScan key = scan_of(blocks, spinner);
  const LabelledScan truth = scan_of(blocks, spinner, T_world_lidar_t);
  const auto [result, status] = resample_on_beams(key.scan, moved_scan(key, T_world_lidar_t));
  ASSERT_EQ(status, Resampling::done);
  const auto true_point = by_beam(truth.scan);
  int right = 0, wrong = 0;
  for (std::size_t i = 0; i < result.scan.size(); ++i) {
    const auto found = true_point.find({result.scan.ring[i], result.scan.column[i]});
    if (found == true_point.end() || result.scan.ring[i] < 32) continue;
    const Eigen::Vector3f& expected = truth.scan.points[found->second];
    ((result.scan.points[i] - expected).norm() < 0.02 ? right : wrong)++;
  }
  EXPECT_GT(right, 5000);
  EXPECT_LT(wrong, 0.03 * right);  // along the wall's foot
}

TEST(Patches, of_points_without_neighbours_face_the_sensor_even_where_rows_do_not_rise) {
  BeamPattern pattern;
  pattern.azimuth_pitch = 0.01F;
  std::vector<Eigen::Vector3f> points;
  for (const float tan_elevation : {0.2F, 0.F, -0.2F}) {
    const int at = static_cast<int>(points.size());
    const float azimuth = 1 + 2 * static_cast<float>(at);
    pattern.rows.push_back({tan_elevation, 0, at, at + 1});
    pattern.order.push_back(at);
    pattern.azimuth.push_back(azimuth);
    points.emplace_back(10 * std::cos(azimuth), 10 * std::sin(azimuth), 10 * tan_elevation);
  }
  const PatchMaker maker(points, pattern, {});
  for (int i = 0; i < 3; ++i) {
    const Patch patch = maker.make(i, i);
    const Eigen::Vector3f normal = patch.frame.row(0), ahead = patch.frame.row(1);
    EXPECT_LT((normal * points[i].norm() - ahead).norm(), 1e-5) << i;
  }
}

TEST(Resample, noise_does_not_grow) {
  Spinner spinner;
  spinner.noise_m = 0.02;
  const Pose T_world_lidar_t = driven(0.5, 0, 0);
  const LabelledScan key = scan_of({kFarWall}, spinner);
  const auto [result, status] = resample_on_beams(key.scan, moved_scan(key, T_world_lidar_t));
  ASSERT_EQ(status, Resampling::done);
  double sq_sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < result.scan.size(); ++i) {
    const Eigen::Vector3d p = T_world_lidar_t * result.scan.points[i].cast<double>();
    if (p.x() < 19 || std::abs(p.y()) > 20 || p.z() < -1) continue;
    sq_sum += (p.x() - 20) * (p.x() - 20);
    ++count;
  }
  EXPECT_GT(count, 3000);
  EXPECT_LT(std::sqrt(sq_sum / count), spinner.noise_m);
}

TEST(Resample, what_turns_into_empty_beams_is_seen_by_them) {
  // A tall wall ahead and sky beside it; the sensor turns by 20 degrees.
  const Block tower{{20, -4, -2}, {21, 4, 6}};
  const Pose T_world_lidar_t = driven(0, 0, 20);
  const LabelledScan key = scan_of({tower}, {}), truth = scan_of({tower}, {}, T_world_lidar_t);
  const auto [result, status] = resample_on_beams(key.scan, moved_scan(key, T_world_lidar_t));
  ASSERT_EQ(status, Resampling::done);
  const auto above = [](const LidarScan& scan) {
    return std::count_if(scan.points.begin(), scan.points.end(),
                         [](const Eigen::Vector3f& p) { return p.z() > 0; });
  };
  EXPECT_NEAR(static_cast<double>(above(result.scan)), static_cast<double>(above(truth.scan)),
              0.03 * static_cast<double>(above(truth.scan)));
  const auto true_point = by_beam(truth.scan);
  int off_the_tower = 0;
  for (std::size_t i = 0; i < result.scan.size(); ++i)
    if (result.scan.points[i].z() > 0 &&
        true_point.count({result.scan.ring[i], result.scan.column[i]}) == 0)
      ++off_the_tower;
  EXPECT_LT(off_the_tower, 60);  // at most a beam on each side
}

TEST(Resample, ring_column_and_time_are_the_beams_the_rest_is_the_surfaces) {
  const Spinner spinner;
  const LabelledScan key = scan_of({kFarWall}, spinner);
  const auto [result, status] = resample_on_beams(key.scan, moved_scan(key, driven(1, 0, 0)));
  ASSERT_EQ(status, Resampling::done);
  const LidarScan& scan = result.scan;
  ASSERT_EQ(by_beam(scan).size(), scan.size());
  ASSERT_EQ(scan.intensity.size(), scan.size());
  ASSERT_EQ(scan.time_s.size(), scan.size());
  ASSERT_EQ(result.source_index.size(), scan.size());
  ASSERT_EQ(result.track_id.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f beam = spinner.direction(scan.ring[i], scan.column[i]).cast<float>();
    ASSERT_LT((scan.points[i].normalized() - beam).norm(), 1e-4);
    ASSERT_NEAR(scan.time_s[i], scan.column[i] * 1e-4, 2e-3);
    ASSERT_EQ(scan.intensity[i], key.scan.intensity[result.source_index[i]]);
  }
  EXPECT_EQ(scan.label, "LIDAR_VIRTUAL");
  EXPECT_EQ(scan.num_rings, 64);
  EXPECT_EQ(scan.num_columns, 1800);
}

TEST(Resample, is_the_same_for_any_number_of_threads) {
  Spinner spinner;
  spinner.noise_m = 0.02;
  const LabelledScan key = scan_of({kFarWall, kPost}, spinner);
  const VirtualScan moved = moved_scan(key, driven(0.7, 0.1, 2), 1, {0, 0.8, 0});
  std::vector<VirtualScan> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(resample_on_beams(key.scan, moved).scan);
  }
  EXPECT_EQ(results[0].scan.points, results[1].scan.points);
  EXPECT_EQ(results[0].source_index, results[1].source_index);
}

TEST(Resample, nothing_is_done_below_the_motion_that_is_worth_it) {
  const LabelledScan key = scan_of({kFarWall, kPost}, {});
  const VirtualScan hardly_moved = moved_scan(key, driven(0.02, 0, 0));
  const auto [result, status] = resample_on_beams(key.scan, hardly_moved);
  EXPECT_EQ(status, Resampling::little_motion);
  EXPECT_EQ(result.scan.points, hardly_moved.scan.points);
  EXPECT_EQ(result.source_index, hardly_moved.source_index);

  const VirtualScan object_moved = moved_scan(key, Pose::Identity(), 1, {0, 0.5, 0});
  EXPECT_EQ(resample_on_beams(key.scan, object_moved).status, Resampling::done);
  EXPECT_EQ(resample_on_beams(key.scan, moved_scan(key, driven(0, 0, 2))).status, Resampling::done);
}

TEST(Resample, a_scan_without_rings_stays_as_it_is) {
  LabelledScan key = scan_of({kFarWall}, {});
  key.scan.ring.clear();
  const VirtualScan moved = moved_scan(key, driven(1, 0, 0));
  const auto [result, status] = resample_on_beams(key.scan, moved);
  EXPECT_EQ(status, Resampling::no_beams);
  EXPECT_EQ(result.scan.points, moved.scan.points);
}

TEST(Resample, works_without_columns) {
  LabelledScan key = scan_of({kFarWall}, {});
  const VirtualScan with = moved_scan(key, driven(1, 0, 0));
  const auto expected = resample_on_beams(key.scan, with);
  key.scan.column.clear();
  key.scan.num_columns = 0;
  const auto [result, status] = resample_on_beams(key.scan, moved_scan(key, driven(1, 0, 0)));
  EXPECT_EQ(status, Resampling::done);
  EXPECT_EQ(result.scan.points, expected.scan.scan.points);
  EXPECT_TRUE(result.scan.column.empty());
}

TEST(Resample, a_virtual_scan_of_another_key_scan_is_rejected) {
  const LabelledScan key = scan_of({kFarWall}, {});
  VirtualScan moved = moved_scan(key, driven(1, 0, 0));
  moved.source_index.back() = static_cast<int>(key.scan.size());
  EXPECT_THROW((void)resample_on_beams(key.scan, moved), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
