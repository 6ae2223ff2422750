// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/partly_hidden.h"

#include <gtest/gtest.h>

#include <memory>

#include "lidar_upsampling/types.h"

#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

constexpr double kSpeed_m_s = 10;

std::shared_ptr<const SeenSpace> wall_at(double range_m) {
  return std::make_shared<const SeenSpace>(testing::wall_at(range_m));
}

/// A car's side of 4 m, known since a second, of which the next scan shows three points.
class PartlyHidden : public ::testing::Test {
 protected:
  void SetUp() override {
    ObjectTrack car;
    car.id = 5;
    car.stamp = scan_.scan.stamp;
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 20; ++i) points.emplace_back(10 + 0.2F * static_cast<float>(i), 5, 0);
    car.surface = std::make_shared<const Surface>(std::move(points));
    car.centroid_rest = {12, 5, 0};
    car.length = 4;
    car.state.stamp = car.stamp;
    car.state.mean[3] = kSpeed_m_s;
    car.state.covariance.diagonal() << 0, 0, 0, 0.01, 0.01, 1e-4, 1, 1;
    car.latest = car.state;
    car.log_odds = car.latest_log_odds = 6;
    store_.tracks = {car};
    store_.next_id = 6;
    scan_.scan.stamp = shifted(car.stamp, 0.1);
    scan_.scan.points = {{13, 5, 0}, {13.2F, 5, 0}, {13.4F, 5.1F, 0}, {13.2F, 7, 0}};
    scan_.seen = wall_at(50);
    scan_.segments.cluster_of.assign(scan_.scan.size(), -1);
  }
  void take_up() { take_up_hidden(scan_, store_, track_of_, options_); }

  PreparedScan scan_;
  TrackStore store_;
  std::vector<int> track_of_;
  TrackOptions options_;
};

TEST_F(PartlyHidden, what_moves_takes_along_the_few_points_that_are_to_be_seen_of_it) {
  take_up();
  ASSERT_EQ(scan_.objects.size(), 1U);
  EXPECT_EQ(scan_.objects.front().points, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(track_of_, std::vector<int>{0});
}

TEST_F(PartlyHidden, it_goes_on_as_it_did_and_all_that_was_seen_of_it_comes_along) {
  const double sigma_before =
      predicted(store_.tracks[0].state, scan_.scan.stamp, {}).covariance(0, 0);
  take_up();
  const ObjectTrack& car = store_.tracks.front();
  EXPECT_EQ(car.id, 5);
  EXPECT_EQ(car.stamp, scan_.scan.stamp);
  ASSERT_EQ(car.surface->points().size(), 20U);
  EXPECT_NEAR(car.surface->points().front().x(), 11, 0.01);
  EXPECT_NEAR(car.centroid_rest.x(), 13, 0.01);
  EXPECT_NEAR(car.expected_at(shifted(car.stamp, 0.1), {}).mean[0], 1, 0.02);
  EXPECT_NEAR(car.state.covariance(0, 0), sigma_before, 1e-12) << "its place is no better known";
  EXPECT_LT(car.log_odds, 6) << "nothing has told that it still moves";
}

/// As before, but that the next scan shows nothing of it.
class Hidden : public PartlyHidden {
 protected:
  void SetUp() override {
    PartlyHidden::SetUp();
    scan_.scan.points = {{3, 0, 0}};
    scan_.segments.cluster_of.assign(1, -1);
    scan_.seen = wall_at(5);
  }
};

TEST_F(Hidden, what_moves_goes_on_behind_what_hides_it) {
  take_up();
  ASSERT_EQ(scan_.objects.size(), 1U);
  EXPECT_TRUE(scan_.objects.front().points.empty());
  EXPECT_NEAR(scan_.objects.front().centroid.x(), 13, 0.01);
  EXPECT_EQ(store_.tracks.front().stamp, scan_.scan.stamp);
  EXPECT_EQ(track_of_, std::vector<int>{0});
}

TEST_F(Hidden, it_is_not_where_the_scan_has_seen_through) {
  scan_.seen = wall_at(50);
  take_up();
  EXPECT_TRUE(scan_.objects.empty());
}

TEST_F(Hidden, it_ends_when_its_place_is_known_no_better_than_it_is_long) {
  store_.tracks[0].latest.covariance.topLeftCorner<2, 2>() =
      1.8 * 1.8 * Eigen::Matrix2d::Identity();
  take_up();
  EXPECT_EQ(scan_.objects.size(), 1U);
  Hidden::SetUp();
  scan_.objects.clear();
  store_.tracks[0].latest.covariance.topLeftCorner<2, 2>() =
      2.2 * 2.2 * Eigen::Matrix2d::Identity();
  take_up();
  EXPECT_TRUE(scan_.objects.empty());
}

TEST_F(PartlyHidden, what_is_parked_leaves_them) {
  store_.tracks[0].latest_log_odds = -2;
  take_up();
  EXPECT_TRUE(scan_.objects.empty());
}

TEST_F(PartlyHidden, what_may_be_elsewhere_leaves_them) {
  store_.tracks[0].latest.covariance(3, 3) = 100;
  take_up();
  EXPECT_TRUE(scan_.objects.empty());
}

TEST_F(PartlyHidden, points_of_another_object_stay_its_own) {
  ScanObject other;
  other.points = {1, 2};
  scan_.objects = {other};
  store_.tracks.push_back(store_.tracks.front());
  store_.tracks.back().centroid_rest.y() += 100;
  auto elsewhere = store_.tracks.back().surface->points();
  for (Eigen::Vector3f& point : elsewhere) point.y() += 100;
  store_.tracks.back().surface = std::make_shared<const Surface>(std::move(elsewhere));
  track_of_ = {1};
  take_up();
  ASSERT_EQ(scan_.objects.size(), 2U);
  EXPECT_EQ(scan_.objects.back().points, std::vector<int>{0});
  EXPECT_EQ(track_of_, (std::vector<int>{1, 0}));
}

TEST_F(PartlyHidden, what_the_scan_has_seen_already_is_not_seen_twice) {
  ScanObject car;
  car.points = {0};
  scan_.objects = {car};
  track_of_ = {0};
  take_up();
  EXPECT_EQ(scan_.objects.size(), 1U);
}

}  // namespace
}  // namespace lidar_upsampling
