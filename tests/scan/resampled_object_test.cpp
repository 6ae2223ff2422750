// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>

#include "lidar_upsampling/scan/resample.h"
#include "spinning_scene.h"

namespace lidar_upsampling {
namespace {

using namespace testing;

constexpr int kCarIndex = 1;
const Block kWallBehind{{18, -30, -2}, {19, 30, 6}};
const Block kCarBefore{{8, -1, -1.7}, {12, 1, -0.2}};
const Eigen::Vector3d kShift(0, 1.5, 0);
const Block kCarAfter{kCarBefore.low + kShift, kCarBefore.high + kShift};

// A car before a wall drives sideways by three quarters of its width; the sensor may drive, too.
class ResampledCar : public ::testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    const LabelledScan key = scan_of({kWallBehind, kCarBefore}, {});
    truth_ = scan_of({kWallBehind, kCarAfter}, {}, T_world_lidar_t_);
    auto resampled =
        resample_on_beams(key.scan, moved_scan(key, T_world_lidar_t_, kCarIndex, kShift));
    ASSERT_EQ(resampled.status, Resampling::done);
    result_ = std::move(resampled.scan);
    true_point_ = by_beam(truth_.scan);
  }

  [[nodiscard]] Eigen::Vector3d in_world(const Eigen::Vector3f& point) const {
    return T_world_lidar_t_ * point.cast<double>();
  }

  // What a beam meets in truth, and its neighbours within two beams, if it is all the same.
  [[nodiscard]] std::optional<int> clear_surface(int ring, int column) const {
    std::optional<int> surface;
    for (int r = ring - 2; r <= ring + 2; ++r)
      for (int c = column - 2; c <= column + 2; ++c) {
        const auto found = true_point_.find({r, c});
        if (found == true_point_.end()) continue;
        if (surface && *surface != truth_.surface[found->second]) return {};
        surface = truth_.surface[found->second];
      }
    return surface;
  }

  const Pose T_world_lidar_t_ = driven(GetParam(), 0, 0);
  LabelledScan truth_;
  VirtualScan result_;
  std::map<std::pair<int, int>, int> true_point_;
};

TEST_P(ResampledCar, hides_what_is_behind_it) {
  int on_car = 0;
  for (std::size_t i = 0; i < result_.scan.size(); ++i) {
    if (clear_surface(result_.scan.ring[i], result_.scan.column[i]) != kCarIndex) continue;
    ASSERT_EQ(result_.track_id[i], 7) << result_.scan.points[i].transpose();
    ++on_car;
  }
  const auto expected = std::count(truth_.surface.begin(), truth_.surface.end(), kCarIndex);
  EXPECT_GT(expected, 1000);
  // Its side comes into sight, which the key scan has not seen.
  EXPECT_GT(on_car, 0.6 * static_cast<double>(expected));
}

TEST_P(ResampledCar, keeps_its_points_on_its_surface) {
  int on_car = 0;
  for (std::size_t i = 0; i < result_.scan.size(); ++i) {
    if (result_.track_id[i] != 7) continue;
    ++on_car;
    // Patches reach half a beam over edges.
    ASSERT_LT(kCarAfter.distance_to(in_world(result_.scan.points[i])), 0.06);
  }
  EXPECT_GT(on_car, 1000);
}

TEST_P(ResampledCar, leaves_no_point_between_itself_and_the_wall) {
  for (const Eigen::Vector3f& point : result_.scan.points) {
    const Eigen::Vector3d p = in_world(point);
    const double to_ground = std::abs(p.z() + kSensorHeight);
    const double to_surface =
        std::min({to_ground, kCarAfter.distance_to(p), kWallBehind.distance_to(p)});
    // Creases are rounded within half a beam.
    ASSERT_LT(to_surface, 0.15) << p.transpose();
  }
}

TEST_P(ResampledCar, does_not_invent_the_wall_and_the_ground_that_it_had_hidden) {
  // Seen from the key scan's place, the uncovered ones lie in the shadow of the car as it was.
  Block core = kCarBefore;
  core.low += Eigen::Vector3d(0, 0.15, 0);
  core.high -= Eigen::Vector3d(0, 0.15, 0.15);
  int in_shadow = 0, in_true_shadow = 0;
  const auto is_hidden = [&](const Eigen::Vector3d& p) {
    const double range = core.range_of(Eigen::Vector3d::Zero(), p.normalized());
    return range + 0.3 < p.norm() && kCarAfter.distance_to(p) > 0.1;
  };
  for (const auto& point : result_.scan.points) in_shadow += is_hidden(in_world(point)) ? 1 : 0;
  for (const auto& point : truth_.scan.points) in_true_shadow += is_hidden(in_world(point)) ? 1 : 0;
  EXPECT_GT(in_true_shadow, 300);
  EXPECT_EQ(in_shadow, 0);
}

INSTANTIATE_TEST_SUITE_P(Driving, ResampledCar, ::testing::Values(0., 0.7));

TEST(ResampledScan, leaves_out_moving_objects_that_are_not_wanted) {
  const LabelledScan key = scan_of({kWallBehind, kCarBefore}, {});
  VirtualScan moved = moved_scan(key, driven(0.7, 0, 0), kCarIndex, kShift);
  ScanMotion motion{moved.scan.stamp, moved.T_lidar_t_lidar_k, false, moved.objects, {}};
  const VirtualScan without = compose_virtual_scan(key.scan, motion, "LIDAR_VIRTUAL",
                                                   {OutsideView::ego, MovingObjects::drop});
  const auto [result, status] = resample_on_beams(key.scan, without);
  ASSERT_EQ(status, Resampling::done);
  EXPECT_EQ(std::count(result.track_id.begin(), result.track_id.end(), 7), 0);
  EXPECT_GT(result.scan.size(), 50000U);
}

}  // namespace
}  // namespace lidar_upsampling
