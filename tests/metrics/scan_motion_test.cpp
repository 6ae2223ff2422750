// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/scan_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "../ego/drive.h"
#include "../ego/street.h"

namespace lidar_upsampling {
namespace {

using testing::angle_between;
using testing::houses;
using testing::lidar_at;
using testing::scan_street;
using testing::translation_between;

LidarScan moved(LidarScan scan, const Pose& T) {
  for (auto& point : scan.points) {
    point = (T * point.cast<double>()).cast<float>();
  }
  return scan;
}

TEST(MatchByBeam, finds_points_again_whatever_their_order) {
  const LidarScan key = scan_street(houses(), lidar_at(0, 0, 0));
  LidarScan warped = moved(key, lidar_at(1, 0, 0.02));
  std::reverse(warped.points.begin(), warped.points.end());
  std::reverse(warped.ring.begin(), warped.ring.end());
  std::reverse(warped.column.begin(), warped.column.end());
  const auto matches = match_by_beam(key, warped);
  ASSERT_EQ(matches.size(), key.size());
  for (int i = 0; i < static_cast<int>(matches.size()); ++i) {
    ASSERT_EQ(matches[i], static_cast<int>(key.size()) - 1 - i);
  }
}

TEST(MatchByBeam, leaves_out_beams_with_several_points) {
  LidarScan key = scan_street(houses(), lidar_at(0, 0, 0));
  key.points.emplace_back(2 * key.points[5]);
  key.ring.push_back(key.ring[5]);
  key.column.push_back(key.column[5]);
  const auto matches = match_by_beam(key, moved(key, lidar_at(1, 0, 0)));
  EXPECT_EQ(matches[5], -1);
  EXPECT_EQ(matches.back(), -1);
  EXPECT_EQ(matches[6], 6);
}

TEST(MatchByBeam, tells_a_scan_drawn_anew_on_the_beams) {
  const LidarScan key = scan_street(houses(), lidar_at(0, 0, 0), 1);
  const LidarScan later = scan_street(houses(), lidar_at(0.5, 0, 0), 2);
  EXPECT_TRUE(match_by_beam(key, later).empty());
  EXPECT_FALSE(match_by_beam(key, key).empty());
}

TEST(MatchByBeam, tells_so_for_a_sensor_at_rest_by_what_has_moved) {
  const LidarScan key = scan_street(houses(), lidar_at(0, 0, 0), 1);
  LidarScan drawn_anew = key, moved_on = key;
  for (std::size_t i = 0; i < key.size() / 20; ++i) {
    drawn_anew.points[i] *= 0.97F;
    moved_on.points[i] += Eigen::Vector3f(0.5F, 0.2F, 0);
  }
  EXPECT_TRUE(match_by_beam(key, drawn_anew).empty());
  EXPECT_EQ(match_by_beam(key, moved_on).size(), key.size());
}

TEST(MatchByBeam, says_nothing_without_rings) {
  LidarScan key = scan_street(houses(), lidar_at(0, 0, 0));
  LidarScan bare = key;
  bare.ring.clear();
  EXPECT_TRUE(match_by_beam(key, bare).empty());
  EXPECT_TRUE(match_by_beam(bare, key).empty());
}

TEST(MatchInOrder, tells_moved_points_without_rings_and_a_scan_of_its_own) {
  LidarScan key = scan_street(houses(), lidar_at(0, 0, 0), 1);
  LidarScan later = scan_street(houses(), lidar_at(0.5, 0, 0), 2);
  later.points.resize(std::min(key.size(), later.size()));
  key.points.resize(later.points.size());
  const auto matches = match_in_order(key, moved(key, lidar_at(1, 0, 0)));
  ASSERT_EQ(matches.size(), key.size());
  EXPECT_EQ(matches[6], 6);
  EXPECT_TRUE(match_in_order(key, later).empty());
  later.points.pop_back();
  EXPECT_TRUE(match_in_order(key, later).empty());
}

TEST(FitRigid, ignores_a_third_of_wrong_pairs) {
  const Pose truth = lidar_at(0.7, -0.2, 0.1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-2, 2);
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
  for (int i = 0; i < 90; ++i) {
    const double x = any(random), y = any(random), z = any(random);
    Eigen::Vector3d moved_point = truth * Eigen::Vector3d(x, y, z);
    if (i % 3 == 0) {
      moved_point += Eigen::Vector3d(1, 0.5, 0);
    }
    pairs.emplace_back(Eigen::Vector3d(x, y, z), moved_point);
  }
  const auto fit = fit_rigid(pairs);
  ASSERT_TRUE(fit);
  EXPECT_LT(translation_between(*fit, truth), 1e-6);
  EXPECT_LT(angle_between(*fit, truth), 1e-6);
}

TEST(FitRigid, gives_nothing_without_a_majority) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-2, 2);
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
  for (int i = 0; i < 40; ++i) {
    const double x = any(random), y = any(random), z = any(random);
    pairs.emplace_back(Eigen::Vector3d(x, y, z), Eigen::Vector3d(z, any(random), any(random)));
  }
  EXPECT_FALSE(fit_rigid(pairs));
  EXPECT_FALSE(fit_rigid({pairs[0], pairs[1]}));
}

}  // namespace
}  // namespace lidar_upsampling
