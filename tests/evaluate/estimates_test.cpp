// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "estimates.h"

#include <gtest/gtest.h>

#include "key_objects.h"
#include "objects/street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;

/// A car that drives off at 10 m/s and a wall beside it, seen every tenth of a second.
LidarScan scan_at(double seconds) {
  const std::vector<BoxObject> boxes{{{12 + 10 * seconds, 2, -1.8}, 4.2, 1.8, 1.5, 0.5},
                                     {{15, -9, -1.8}, 40, 0.5, 3, 0}};
  auto street = testing::make_street(testing::flat, boxes, 64, 1800, 0.005);
  street.scan.stamp = shifted(Stamp{}, 100 + seconds);
  return street.scan;
}

class Rows : public ::testing::Test {
 protected:
  Rows() {
    for (std::size_t i = 0; i < key_.size(); ++i) {
      const Eigen::Vector3f& p = key_.points[i];
      if (p.x() > 10 && p.x() < 17 && p.y() > 0 && p.y() < 4 && p.z() > -1.7)
        car_.points.push_back(static_cast<int>(i));
    }
    car_.motion.centroid_k = mean_of(points_at(key_, car_.points));
    car_.motion.T_lidar_t_lidar_k = Pose(Eigen::Translation3d(1, 0, 0));
  }

  [[nodiscard]] Estimates estimates(const ScanSet& scans) const {
    return estimates_of(car_, prepare_rows(scans, Pose::Identity()));
  }

  LidarScan previous_ = scan_at(0), key_ = scan_at(0.1), later_ = scan_at(0.2);
  ObjectReference car_;
};

TEST_F(Rows, constant_velocity_goes_on_as_between_the_last_two_scans) {
  std::vector<ObjectReference> objects{car_};
  LastMotions(previous_, Pose::Identity(), 0.1).find(objects, {0}, key_, {});
  car_ = objects.front();
  const Estimates rows = estimates({key_, later_, later_});
  ASSERT_TRUE(rows[Row::constant_velocity]);
  EXPECT_LT(position_error(car_.motion, *rows[Row::constant_velocity]), 0.05);
}

TEST_F(Rows, constant_velocity_finds_what_is_fast_once_it_has_been_found) {
  // As if the car had been found at the scan before: nothing else leads 8 m back.
  const double step = 8;
  LidarScan far = previous_;
  for (Eigen::Vector3f& point : far.points) point.x() -= static_cast<float>(step - 1);
  ObjectReference before = car_;
  before.motion.centroid_k.x() -= step;
  before.last_motion = LastMotion{};
  before.last_motion->per_second[3] = step / 0.1;
  std::vector<ObjectReference> unaided{car_}, led{car_};
  const LastMotions motions(far, Pose::Identity(), 0.1);
  motions.find(unaided, {0}, key_, {});
  motions.find(led, {0}, key_, {before});
  EXPECT_FALSE(unaided.front().last_motion);
  ASSERT_TRUE(led.front().last_motion);
  EXPECT_NEAR(led.front().last_motion->per_second[3], step / 0.1, 1);
}

TEST_F(Rows, without_an_earlier_scan_constant_velocity_is_left_with_the_ego_motion) {
  const Estimates rows = estimates({key_, later_, later_});
  ASSERT_TRUE(rows[Row::constant_velocity]);
  EXPECT_TRUE(rows[Row::constant_velocity]->isApprox(Pose::Identity()));
}

TEST_F(Rows, a_copy_of_the_key_scan_is_told_to_have_stayed) {
  LidarScan copy = key_;
  copy.stamp = later_.stamp;
  const Estimates rows = estimates({key_, copy, later_});
  ASSERT_TRUE(rows[Row::ours]);
  EXPECT_NEAR(position_error(car_.motion, *rows[Row::ours]), 1, 1e-3);
  EXPECT_NEAR(position_error(car_.motion, *rows[Row::hold]), 1, 1e-9);
}

TEST_F(Rows, a_scan_with_points_of_its_own_is_judged_by_registration) {
  // The street's noise is the same in every scan: this is what makes a measurement of its own.
  for (std::size_t i = 0; i < later_.size(); ++i) later_.points[i] *= i % 2 == 0 ? 1.001F : 0.999F;
  const Estimates rows = estimates({key_, later_, later_});
  ASSERT_TRUE(rows[Row::ours]);
  EXPECT_LT(position_error(car_.motion, *rows[Row::ours]), 0.05);
}

}  // namespace
}  // namespace lidar_upsampling
