// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "instant_reference.h"

#include <gtest/gtest.h>

#include "key_objects.h"
#include "objects/street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;

/// A car that drives off at 10 m/s, one that is parked, and walls; the sensor stands.
LidarScan standing_scan(double seconds) {
  const std::vector<BoxObject> boxes{{{12 + 10 * seconds, 2, -1.8}, 4.2, 1.8, 1.5, 0},
                                     {{18, -4, -1.8}, 4.2, 1.8, 1.5, 0},
                                     {{15, -9, -1.8}, 40, 0.5, 3, 0},
                                     {{40, 5, -1.8}, 0.5, 30, 3, 0}};
  auto street = testing::make_street(testing::flat, boxes, 64, 1800, 0.005);
  street.scan.stamp = shifted(Stamp{}, 100 + seconds);
  return street.scan;
}

class References : public ::testing::Test {
 protected:
  [[nodiscard]] std::optional<InstantReference> at(double seconds, const ScansAround& around) {
    return reference_by_registration(
        motions_, {key_, objects_, around, shifted(Stamp{}, 100 + seconds), {}, options_},
        Twist::Zero());
  }

  /// The object whose centroid at the key scan is within a metre of a place.
  static const ObjectReference* near(const InstantReference& reference, double x, double y) {
    for (const ObjectReference& object : reference.objects)
      if ((object.motion.centroid_k.head<2>() - Eigen::Vector2d(x, y)).norm() < 1.5) return &object;
    return nullptr;
  }

  static Eigen::Vector3d step_of(const ObjectReference& object) {
    return object.motion.T_lidar_t_lidar_k * object.motion.centroid_k - object.motion.centroid_k;
  }

  EvaluationOptions options_;
  LidarScan key_ = standing_scan(0), first_ = standing_scan(0.1), second_ = standing_scan(0.2);
  std::vector<ObjectReference> objects_ = objects_by_clusters(key_);
  RegisteredMotions motions_{key_, objects_, options_};
};

TEST_F(References, between_two_withheld_scans_a_mover_is_between_its_places_there) {
  const auto reference = at(0.13, {&first_, &second_, &first_});
  ASSERT_TRUE(reference);
  EXPECT_TRUE(reference->interpolated);
  const ObjectReference* car = near(*reference, 11, 1.5);
  ASSERT_NE(car, nullptr);
  EXPECT_TRUE(car->moving);
  EXPECT_NEAR(step_of(*car).x(), 1.3, 0.03);
  EXPECT_GT(car->motion.sigma_m, 0.005);
}

TEST_F(References, before_the_first_withheld_scan_the_key_scan_is_the_other_end) {
  const auto reference = at(0.04, {nullptr, &first_, &first_});
  ASSERT_TRUE(reference);
  const ObjectReference* car = near(*reference, 11, 1.5);
  ASSERT_NE(car, nullptr);
  EXPECT_NEAR(step_of(*car).x(), 0.4, 0.02);
}

TEST_F(References, what_stands_goes_with_the_ego_motion) {
  const auto reference = at(0.13, {&first_, &second_, &first_});
  ASSERT_TRUE(reference);
  const ObjectReference* parked = near(*reference, 17, -3.5);
  ASSERT_NE(parked, nullptr);
  EXPECT_FALSE(parked->moving);
  EXPECT_LT(step_of(*parked).norm(), 0.005);
}

TEST_F(References, a_scan_of_the_same_stamp_is_taken_as_it_is) {
  const auto reference = at(0.1, {nullptr, &first_, &first_});
  ASSERT_TRUE(reference);
  EXPECT_FALSE(reference->interpolated);
  EXPECT_EQ(reference->scan.points, first_.points);
}

TEST_F(References, the_scan_is_brought_to_the_instant_with_what_moves_on_it) {
  const auto reference = at(0.13, {&first_, &second_, &first_});
  ASSERT_TRUE(reference);
  ASSERT_EQ(reference->scan.size(), first_.size());
  double moved = 0;
  int on_car = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const Eigen::Vector3f& point = first_.points[i];
    const Eigen::Vector3f step = reference->scan.points[i] - point;
    const bool is_car = point.x() > 10 && point.x() < 16 && std::abs(point.y() - 2) < 1 &&
                        point.z() > -1.4 && point.z() < 0;
    if (is_car) moved += step.x(), ++on_car;
    if (point.x() > 35) {
      EXPECT_LT(step.norm(), 0.02) << point.transpose();
    }
  }
  ASSERT_GT(on_car, 50);
  EXPECT_NEAR(moved / on_car, 0.3, 0.03);
}

}  // namespace
}  // namespace lidar_upsampling
