// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/sweep.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace lidar_upsampling {
namespace {

constexpr double kPeriod_s = 0.1;

LidarScan scan_of(const std::vector<double>& azimuths_deg) {
  LidarScan scan;
  scan.label = "LIDAR";
  for (const double azimuth : azimuths_deg) {
    const double a = azimuth * M_PI / 180;
    scan.points.emplace_back(static_cast<float>(20 * std::cos(a)),
                             static_cast<float>(20 * std::sin(a)), -1.F);
  }
  return scan;
}

SweepOptions by_azimuth() {
  SweepOptions options;
  options.scan_time = ScanTime::azimuth;
  return options;
}

/// A lidar that drives and turns, at rest in the world's origin at its stamp.
Twist driving() { return (Twist() << 0.01, -0.02, 0.4, 12, 0.3, 0.1).finished(); }

Pose T_k_lidar(const Twist& rate_over_ground, double time) {
  return exp_se3(Twist(time * rate_over_ground));
}

Pose on_the_way(double time) { return T_k_lidar(driving(), time); }

TEST(Sweep, by_default_the_scanner_turns_clockwise_from_the_rear_and_the_stamp_is_in_front) {
  const auto times = point_times(scan_of({179, 90, 0, -90, -179}), by_azimuth(), kPeriod_s);
  ASSERT_EQ(times.size(), 5U);
  EXPECT_NEAR(times[0], -0.05 + 0.1 / 360, 1e-6);
  EXPECT_NEAR(times[1], -0.025, 1e-6);
  EXPECT_NEAR(times[2], 0, 1e-6);
  EXPECT_NEAR(times[3], 0.025, 1e-6);
  EXPECT_NEAR(times[4], 0.05 - 0.1 / 360, 1e-6);
}

TEST(Sweep, start_direction_and_reference_are_settings) {
  SweepOptions options = by_azimuth();
  options.start_deg = 90;
  options.direction = TurnDirection::counterclockwise;
  options.reference = 1;
  const auto times = point_times(scan_of({91, 180, -90, 89}), options, kPeriod_s);
  EXPECT_NEAR(times[0], -0.1 + 0.1 / 360, 1e-6);
  EXPECT_NEAR(times[1], -0.075, 1e-6);
  EXPECT_NEAR(times[2], -0.05, 1e-6);
  EXPECT_NEAR(times[3], -0.1 / 360, 1e-6);
}

SweepOptions not_at_all() {
  SweepOptions options;
  options.scan_time = ScanTime::none;
  return options;
}

TEST(Sweep, nothing_is_known_without_a_period_nor_asked_with_none) {
  EXPECT_TRUE(point_times(scan_of({0, 90}), by_azimuth(), 0).empty());
  LidarScan timed = scan_of({0, 90});
  timed.time_s = {0.01F, 0.02F};
  EXPECT_TRUE(point_times(timed, not_at_all(), kPeriod_s).empty());
}

TEST(Sweep, times_are_taken_by_default_where_the_log_tells_different_ones) {
  LidarScan scan = scan_of({0, 90});
  EXPECT_TRUE(point_times(scan, {}, kPeriod_s).empty());
  scan.time_s = {0.01F, 0.01F};
  EXPECT_TRUE(point_times(scan, {}, kPeriod_s).empty()) << "all at once";
  scan.time_s = {0.01F, 0.06F};
  EXPECT_EQ(point_times(scan, {}, kPeriod_s), scan.time_s);
}

TEST(Sweep, times_that_most_points_lack_are_not_taken_by_default) {
  LidarScan scan = scan_of({0, 10, 20});
  scan.time_s = {0.01F, -4e8F, -4e8F};
  EXPECT_EQ(drop_points_without_time(scan, {}), 0U);
  EXPECT_TRUE(point_times(scan, {}, kPeriod_s).empty());
  scan.time_s = {0.01F, 0.02F, -4e8F};
  EXPECT_EQ(drop_points_without_time(scan, {}), 1U);
  EXPECT_EQ(point_times(scan, {}, kPeriod_s), (std::vector<float>{0.01F, 0.02F}));
}

TEST(Sweep, a_turn_takes_the_shortest_time_between_two_scans_if_no_setting_tells) {
  const Stamp start = shifted(Stamp{}, 1e6);
  const std::vector<Stamp> scans{start, shifted(start, 0.2), shifted(start, 0.3),
                                 shifted(start, 0.3), shifted(start, 0.5)};
  SweepOptions options;
  EXPECT_NEAR(turn_s(options, scans), 0.1, 1e-9);
  EXPECT_NEAR(turn_s(options, scans, 0.05), 0.05, 1e-9);
  EXPECT_EQ(turn_s(options, {start}), 0);
  options.period_ms = 50;
  EXPECT_NEAR(turn_s(options, scans), 0.05, 1e-9);
}

TEST(Sweep, scans_too_far_apart_for_a_turn_tell_no_times) {
  EXPECT_FALSE(point_times(scan_of({0, 90}), by_azimuth(), 1).empty());
  constexpr double kYear_s = 3e7;
  EXPECT_TRUE(point_times(scan_of({0, 90}), by_azimuth(), kYear_s).empty());
}

TEST(Sweep, the_points_own_times_are_taken_and_missing_ones_are_an_error) {
  LidarScan scan = scan_of({0, 90});
  SweepOptions options;
  options.scan_time = ScanTime::points;
  EXPECT_THROW((void)point_times(scan, options, kPeriod_s), std::runtime_error);
  scan.time_s = {0.01F, 0.02F};
  EXPECT_EQ(point_times(scan, options, 0), scan.time_s);
}

TEST(Sweep, points_measured_under_way_are_put_where_the_world_has_them) {
  std::vector<double> azimuths;
  azimuths.reserve(720);
  for (int i = 0; i < 720; ++i) azimuths.push_back(179.75 - 0.5 * i);
  const LidarScan truth = scan_of(azimuths);
  const auto times = point_times(truth, by_azimuth(), kPeriod_s);
  LidarScan sheared = truth;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sheared.points[i] =
        (T_k_lidar(driving(), times[i]).inverse() * truth.points[i].cast<double>()).cast<float>();
  ASSERT_GT((sheared.points.front() - truth.points.front()).norm(), 0.5);

  LidarScan straight = sheared;
  deskew(straight, times, on_the_way);
  for (std::size_t i = 0; i < truth.size(); ++i)
    ASSERT_LT((straight.points[i] - truth.points[i]).norm(), 5e-5) << i;
  EXPECT_EQ(straight.time_s, times);
}

TEST(Sweep, a_scan_without_times_stays_as_it_is) {
  LidarScan scan = scan_of({0, 90});
  const auto before = scan.points;
  deskew(scan, {}, on_the_way);
  EXPECT_EQ(scan.points, before);
  EXPECT_TRUE(scan.time_s.empty());
}

TEST(Sweep, all_points_at_one_instant_move_alike) {
  LidarScan scan = scan_of({0, 90});
  const auto before = scan.points;
  deskew(scan, {0.03F, 0.03F}, on_the_way);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((scan.points[i].cast<double>() - on_the_way(0.03) * before[i].cast<double>()).norm(),
              1e-5);
}

TEST(Sweep, points_without_a_time_near_the_stamp_are_left_out_with_all_their_fields) {
  SweepOptions options;
  options.scan_time = ScanTime::points;
  LidarScan scan = scan_of({0, 10, 20, 30, 40});
  scan.time_s = {0.01F, -4e8F, std::numeric_limits<float>::quiet_NaN(), 1.5F, -0.05F};
  scan.ring = {0, 1, 2, 3, 4};
  EXPECT_THROW((void)point_times(scan, options, kPeriod_s), std::runtime_error);
  const auto points = scan.points;
  EXPECT_EQ(drop_points_without_time(scan, options), 3U);
  EXPECT_EQ(scan.label, "LIDAR");
  EXPECT_EQ(scan.points, (std::vector<Eigen::Vector3f>{points[0], points[4]}));
  EXPECT_EQ(scan.ring, (std::vector<std::uint16_t>{0, 4}));
  EXPECT_EQ(point_times(scan, options, kPeriod_s), (std::vector<float>{0.01F, -0.05F}));
}

TEST(Sweep, times_that_are_not_used_cost_no_points) {
  LidarScan scan = scan_of({0, 10});
  scan.time_s = {0.01F, -4e8F};
  EXPECT_EQ(drop_points_without_time(scan, not_at_all()), 0U);
  EXPECT_EQ(drop_points_without_time(scan, by_azimuth()), 0U);
  EXPECT_EQ(scan.size(), 2U);
}

TEST(Sweep, the_mean_time_is_that_of_the_chosen_points) {
  EXPECT_NEAR(mean_time({0.01F, 0.02F, 0.06F}, {0, 2}), 0.035, 1e-7);
  EXPECT_EQ(mean_time({}, {0, 2}), 0);
  EXPECT_EQ(mean_time({0.01F}, {}), 0);
}

}  // namespace
}  // namespace lidar_upsampling
