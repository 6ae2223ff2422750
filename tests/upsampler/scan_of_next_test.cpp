// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan_of_next.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lidar_upsampling/registration/point_index.h"
#include "scan/spinning_scene.h"
#include "street_run.h"

namespace lidar_upsampling {
namespace {

using namespace testing;

constexpr int kVanBlock = 0, kNewcomer = 2;
constexpr double kRings_deg = 27. / 63;

/// A van that drives off by 1 m until the next scan, and something there that the key scan saw
/// nothing of. The sensor goes on by 0.8 m.
class NextScanView : public ::testing::Test {
 protected:
  static std::vector<Block> blocks(double shift, bool with_newcomer) {
    std::vector<Block> all{{{8 + shift, -1, -1.3}, {12 + shift, 1, 0.5}},
                           {{25, -30, -2}, {26, 30, 6}}};
    if (with_newcomer) all.push_back({{7, 3, -1.5}, {8, 4, 0}});
    return all;
  }

  void SetUp() override {
    // The camera's stamps are 12 ms late: all is told of an instant before.
    of_key_.stamp = shifted(key_.scan.stamp, 0.062);
    of_key_.T_lidar_t_lidar_k = driven(0.4, 0, 0).inverse();
    ObjectMotion van;
    van.track_id = 7;
    van.status = MotionStatus::moving;
    van.T_mov = Eigen::Translation3d(0.5, 0, 0) * Pose::Identity();
    van.rate_lidar_k = log_se3(van.T_mov) / 0.05;
    van.T_lidar_t_lidar_k = of_key_.T_lidar_t_lidar_k * van.T_mov;
    for (int i = 0; i < static_cast<int>(key_.scan.size()); ++i)
      if (key_.surface[i] == kVanBlock) van.points.push_back(i);
    of_key_.objects.push_back(van);
    next_.scan = seen_.scan;
    next_.scan.stamp = shifted(key_.scan.stamp, 0.1);
    next_.T_scan_before = driven(0.8, 0, 0).inverse();
    next_.segments = segment_scan(next_.scan);
  }

  [[nodiscard]] ScanMotion motion() const {
    return motion_of_next(next_, of_key_, key_.scan, SeenSpace(key_.scan.points, kRings_deg));
  }
  // How many of these points lie on a block, or on the ground.
  [[nodiscard]] std::ptrdiff_t count(const std::vector<int>& points, int surface) const {
    return std::count_if(points.begin(), points.end(),
                         [&](int i) { return seen_.surface[i] == surface; });
  }
  [[nodiscard]] std::ptrdiff_t all_on(int surface) const {
    return std::count(seen_.surface.begin(), seen_.surface.end(), surface);
  }

  LabelledScan key_ = scan_of(blocks(0, false), {});
  LabelledScan seen_ = scan_of(blocks(1, true), {}, driven(0.8, 0, 0));
  ScanMotion of_key_;
  PreparedScan next_;
};

TEST_F(NextScanView, a_mover_takes_along_what_shows_it_and_nothing_else) {
  const ScanMotion found = motion();
  ASSERT_EQ(found.objects.size(), 1U);
  const std::vector<int>& points = found.objects.front().points;
  EXPECT_EQ(found.objects.front().track_id, 7);
  EXPECT_GT(static_cast<double>(count(points, kVanBlock)),
            0.95 * static_cast<double>(all_on(kVanBlock)));
  EXPECT_GT(static_cast<double>(count(points, kVanBlock)),
            0.98 * static_cast<double>(points.size()));
}

TEST_F(NextScanView, all_go_back_to_the_instant) {
  const ScanMotion found = motion();
  EXPECT_TRUE(found.T_lidar_t_lidar_k.isApprox(driven(0.4, 0, 0), 1e-9));
  // The van has half of its metre to go back, and the sensor its 0.4 m.
  const Pose expected = driven(0.4 - 0.5, 0, 0);
  EXPECT_TRUE(found.objects.front().T_lidar_t_lidar_k.isApprox(expected, 1e-9));
}

TEST_F(NextScanView, what_stands_where_nothing_was_is_left_out) {
  const std::vector<int> left_out = motion().left_out;
  EXPECT_GT(static_cast<double>(count(left_out, kNewcomer)),
            0.9 * static_cast<double>(all_on(kNewcomer)));
  EXPECT_EQ(count(left_out, kVanBlock), 0);
  EXPECT_LT(static_cast<double>(left_out.size()), 1.2 * static_cast<double>(all_on(kNewcomer)));
}

// Mean distance of what the sensor would have measured from what the virtual scans show.
double distance_from_truth(const StreetRun& street, const std::vector<VirtualScan>& scans) {
  constexpr float kFarthest_m = 0.5F;
  double sum = 0;
  std::size_t count = 0;
  for (const VirtualScan& scan : scans) {
    const PointIndex index(scan.scan.points);
    for (const Eigen::Vector3f& point : street.scan_at(scan.scan.stamp).scan.points) {
      const auto nearest = index.nearest(point, kFarthest_m * kFarthest_m);
      sum += nearest.index < 0 ? kFarthest_m : std::sqrt(nearest.sq_distance);
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

TEST(LidarUpsampler, drawn_from_both_scans_a_virtual_one_shows_more_of_what_is_there) {
  StreetRun street;
  LidarUpsampler causal{Config()}, offline{Config()};
  const auto blind = street.run(causal), knowing = street.run(offline, true, true);
  ASSERT_EQ(blind.size(), knowing.size());
  EXPECT_LT(distance_from_truth(street, knowing), 0.9 * distance_from_truth(street, blind));
}

}  // namespace
}  // namespace lidar_upsampling
