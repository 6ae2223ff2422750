// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "straight_scans.h"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluate/stamps.h"
#include "objects/street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;

constexpr double kSpeed_mps = 12;

Pose place_at(double seconds) { return Pose(Eigen::Translation3d(kSpeed_mps * seconds, 0, 0)); }

LidarScan standing_street(double seconds) {
  std::vector<BoxObject> boxes{{{18, -4, -1.8}, 4.2, 1.8, 1.5, 0}, {{8, 6, -1.8}, 4.2, 1.8, 1.5, 0},
                               {{15, -9, -1.8}, 20, 0.5, 3, 0},    {{-9, 9, -1.8}, 12, 0.5, 3, 0},
                               {{40, 5, -1.8}, 0.5, 30, 3, 0},     {{-20, 0, -1.8}, 0.5, 30, 3, 0}};
  for (BoxObject& box : boxes) box.center.x() -= kSpeed_mps * seconds;
  auto street = testing::make_street(testing::flat, boxes, 64, 1800, 0.005);
  street.scan.stamp = at(seconds);
  return street.scan;
}

/// What a lidar that drives along the street takes in a tenth of a second, and as it would have
/// been at once.
struct Sweep {
  LidarScan swept, at_once;

  explicit Sweep(double seconds) : swept(standing_street(seconds)), at_once(swept) {
    for (Eigen::Vector3f& point : swept.points) {
      const double time = 0.05 * std::atan2(point.y(), point.x()) / M_PI;
      swept.time_s.push_back(static_cast<float>(time));
      const Pose T_then_now = place_at(seconds + time).inverse() * place_at(seconds);
      point = (T_then_now * point.cast<double>()).cast<float>();
    }
  }

  /// Mean distance of a scan's points from where they would have been.
  [[nodiscard]] double error_of(const LidarScan& scan) const {
    double sum = 0;
    for (std::size_t i = 0; i < scan.size(); ++i)
      sum += (scan.points[i] - at_once.points[i]).norm();
    return sum / static_cast<double>(scan.size());
  }
};

StraightScans as_the_log_tells(const Truth* truth) {
  return {SweepOptions{}, {at(0), at(0.1)}, truth};
}

TEST(StraightScans, without_a_truth_the_scan_before_tells_how_the_lidar_went) {
  const Sweep first(0), second(0.1);
  StraightScans scans = as_the_log_tells(nullptr);
  EXPECT_NEAR(first.error_of(scans.straight(first.swept)), first.error_of(first.swept), 1e-4)
      << "nothing is known yet";
  ASSERT_GT(second.error_of(second.swept), 0.2);
  EXPECT_LT(second.error_of(scans.straight(second.swept)), 0.01);
}

TEST(StraightScans, the_first_ones_as_they_are_tell_enough_to_begin_with) {
  const Sweep first(0), second(0.1);
  StraightScans scans = as_the_log_tells(nullptr);
  scans.start_with(first.swept, second.swept);
  EXPECT_LT(first.error_of(scans.straight(first.swept)), 0.02);
}

TEST(StraightScans, the_truth_straightens_the_first_one_too) {
  Truth truth;
  for (const double t : {-0.1, 0., 0.1})
    truth.T_world_vehicle.add({at(t), Pose(Eigen::Translation3d(kSpeed_mps * t, 0, 0))});
  const Sweep first(0);
  EXPECT_LT(first.error_of(as_the_log_tells(&truth).straight(first.swept)), 1e-3);
}

TEST(StraightScans, a_scan_without_instants_stays_as_it_is) {
  const Sweep first(0), second(0.1);
  StraightScans scans = as_the_log_tells(nullptr);
  EXPECT_EQ(scans.straight(first.at_once).points, first.at_once.points);
  EXPECT_EQ(scans.straight(second.at_once).points, second.at_once.points);
}

}  // namespace
}  // namespace lidar_upsampling
