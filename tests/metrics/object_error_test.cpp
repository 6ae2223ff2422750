// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/object_error.h"

#include <gtest/gtest.h>

#include "../ego/drive.h"
#include "../ego/street.h"
#include "lidar_upsampling/metrics/scan_motion.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

using testing::box_at;
using testing::houses;
using testing::lidar_at;
using testing::Points;
using testing::scan_street;

/// A street with one car that drives on from the key scan to the reference; the ego drives, too.
struct Scene {
  double dt = 0.1;
  Pose T_world_k = lidar_at(0, 0, 0), T_world_t = lidar_at(0.8, 0, 0.01);
  Pose T_ego = T_world_t.inverse() * T_world_k;
  Pose T_object;  // truth
  LidarScan key, reference;
  std::vector<int> object;  // indices into key
  Points points;

  explicit Scene(const testing::Box& car_k, const testing::Box& car_t) {
    auto before = houses(), after = houses();
    before.push_back(car_k);
    after.push_back(car_t);
    std::vector<int> owner, owner_t;
    key = scan_street(before, T_world_k, 1, &owner);
    reference = without_ground(scan_street(after, T_world_t, 2, &owner_t), owner_t);
    for (int i = 0; i < static_cast<int>(key.size()); ++i) {
      if (owner[i] == static_cast<int>(before.size()) - 1) {
        object.push_back(i);
        points.push_back(key.points[i]);
      }
    }
    T_object = T_world_t.inverse() * car_t.T_world_box * car_k.T_world_box.inverse() * T_world_k;
  }

  static LidarScan without_ground(const LidarScan& scan, const std::vector<int>& owner) {
    LidarScan kept;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (owner[i] >= 0) {
        kept.points.push_back(scan.points[i]);
      }
    }
    return kept;
  }
  /// The key scan with the object moved by T_object_moved and the rest by the ego-motion.
  [[nodiscard]] LidarScan virtual_scan(const Pose& T_object_moved) const {
    LidarScan scan = key;
    for (auto& point : scan.points) {
      point = (T_ego * point.cast<double>()).cast<float>();
    }
    for (const int i : object) {
      scan.points[i] = (T_object_moved * key.points[i].cast<double>()).cast<float>();
    }
    return scan;
  }
  [[nodiscard]] ReferenceMotion truth() const { return {mean_of(points), T_object, 0.02}; }
};

const testing::Box kOncomingK = box_at(18, 3, 3.14), kOncomingT = box_at(17, 3, 3.13);

TEST(ObjectRegistration, finds_the_motion_of_cars_that_turn_overtake_and_come) {
  const std::vector<std::pair<testing::Box, testing::Box>> drives{
      {kOncomingK, kOncomingT},
      {box_at(15, -3.2, 0), box_at(16.4, -3.2, 0)},
      {box_at(12, 4, 1.0), box_at(12.5, 4.7, 1.06)},
      {box_at(14, 3.5, 0), box_at(14, 3.5, 0)}};
  for (const auto& [car_k, car_t] : drives) {
    const Scene scene(car_k, car_t);
    ASSERT_GE(scene.points.size(), 30U);
    const auto found = register_object(scene.points, Surface(scene.reference.points),
                                       {scene.T_ego, Pose::Identity()});
    EXPECT_EQ(found.status, RegistrationStatus::reliable) << to_string(found.status);
    EXPECT_LT(position_error(scene.truth(), found.T_target_object), 0.06);
  }
}

TEST(ObjectRegistration, says_so_when_the_object_has_gone) {
  Scene scene(kOncomingK, box_at(300, 0, 0));
  const auto found = register_object(scene.points, Surface(scene.reference.points), {scene.T_ego});
  EXPECT_EQ(found.status, RegistrationStatus::poor_overlap);
}

TEST(ObjectRegistration, says_so_when_a_wall_slides_on_itself) {
  // The middle of a long plain wall could go anywhere along it.
  Points wall, part;
  for (int i = -100; i < 100; ++i) {
    for (int k = 0; k < 10; ++k) {
      const Eigen::Vector3f point(0.11F * static_cast<float>(i), 8, 0.2F * static_cast<float>(k));
      wall.push_back(point);
      if (std::abs(i) < 20) {
        part.emplace_back(point + Eigen::Vector3f(0.05F, 0, 0.1F));
      }
    }
  }
  const auto found = register_object(part, Surface(wall), {Pose::Identity()});
  EXPECT_EQ(found.status, RegistrationStatus::ambiguous);
}

TEST(ObjectRegistration, does_not_take_the_pattern_of_the_points_for_the_place_of_a_side) {
  // Two rings on a long side: its points lie at the sensor's azimuths, wherever it is.
  const auto side = [](float from_m) {
    std::vector<Eigen::Vector3f> points;
    for (const float z : {-0.6F, 0.6F})
      for (float x = 20; x < 40; x += 0.5F)
        if (x >= from_m) points.emplace_back(x, 9, z);
    return points;
  };
  ObjectRegistrationOptions options;
  options.min_points = 10;
  options.search_m = 0;
  options.max_shift_m = 0.6;
  const auto found = register_object(side(34.8F), Surface(side(34)), {Pose::Identity()}, options);
  ASSERT_NE(found.status, RegistrationStatus::too_few_points);
  const double off = found.T_target_object.translation().x() + 0.8;
  EXPECT_LT(off * off, 4 * found.slack(0, 0));
}

TEST(ObjectRegistration, refuses_a_handful_of_points_and_no_guess) {
  const Scene scene(kOncomingK, kOncomingT);
  const Surface surface = Surface(scene.reference.points);
  const Points few(scene.points.begin(), scene.points.begin() + 10);
  EXPECT_EQ(register_object(few, surface, {Pose::Identity()}).status,
            RegistrationStatus::too_few_points);
  EXPECT_THROW(static_cast<void>(register_object(few, surface, {})), std::invalid_argument);
}

TEST(ObjectError, is_zero_for_a_perfect_virtual_scan_and_the_step_for_a_copied_one) {
  const Scene scene(kOncomingK, kOncomingT);
  const ReferenceMotion truth = scene.truth();
  const double hold = position_error(truth, Pose::Identity());
  EXPECT_GT(hold, 1.5);  // the car's metre and the ego's 0.8

  const LidarScan perfect = scene.virtual_scan(scene.T_object);
  const auto recovered =
      recover_motion(scene.key, perfect, scene.object, match_by_beam(scene.key, perfect),
                     Surface({}), {scene.T_ego});
  ASSERT_TRUE(recovered);
  EXPECT_LT(position_error(truth, *recovered), 1e-4);

  const auto copied =
      recover_motion(scene.key, scene.key, scene.object, match_by_beam(scene.key, scene.key),
                     Surface({}), {scene.T_ego});
  ASSERT_TRUE(copied);
  EXPECT_NEAR(position_error(truth, *copied), hold, 1e-4);
}

TEST(ObjectError, is_recovered_from_points_alone_when_the_carrier_lost_the_rings) {
  const Scene scene(kOncomingK, kOncomingT);
  const LidarScan perfect = scene.virtual_scan(scene.T_object);
  const auto recovered =
      recover_motion(scene.key, perfect, scene.object, {}, Surface(perfect.points), {scene.T_ego});
  ASSERT_TRUE(recovered);
  EXPECT_LT(position_error(scene.truth(), *recovered), 0.02);
}

TEST(ObjectError, moving_means_over_ground_and_beyond_doubt) {
  const Scene driving(kOncomingK, kOncomingT), parked(kOncomingK, kOncomingK);
  EXPECT_TRUE(is_moving(driving.truth(), driving.T_ego, 0.1));
  EXPECT_NEAR(velocity_error(driving.truth(), driving.T_ego, 0.1), 10, 0.5);
  EXPECT_FALSE(is_moving(parked.truth(), parked.T_ego, 0.1));
  ReferenceMotion vague = driving.truth();
  vague.sigma_m = 0.5;
  EXPECT_FALSE(is_moving(vague, driving.T_ego, 0.1));
  EXPECT_THROW(static_cast<void>(is_moving(vague, driving.T_ego, 0)), std::invalid_argument);
}

TEST(ObjectError, of_depth_is_a_share_of_what_lies_before_the_camera) {
  // The object stands 20 m before the lidar, 19.5 m before the camera; the estimate 0.39 m beyond
  // it and a metre aside, which is no error of depth.
  const ReferenceMotion object{{21, 2, 0}, Pose(Eigen::Translation3d(-1, 0, 0)), 0.02};
  const Pose T_estimate(Eigen::Translation3d(-0.61, 1, 0));
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T_camera_lidar.translation() = Eigen::Vector3d(0, 0, -0.5);
  EXPECT_NEAR(depth_error(object, T_estimate, T_camera_lidar).value(), 0.02, 1e-12);
  const ReferenceMotion behind{{-5, 2, 0}, Pose::Identity(), 0.02};
  EXPECT_FALSE(depth_error(behind, Pose::Identity(), T_camera_lidar));
}

TEST(ObjectError, of_yaw_is_the_angle_about_the_lidars_axis) {
  const auto yawed = [](double yaw) { return lidar_at(3, 1, yaw); };
  EXPECT_NEAR(yaw_error({{10, 0, 0}, yawed(0.2), 0.02}, yawed(0.5)), 0.3, 1e-12);
  EXPECT_NEAR(yaw_error({{10, 0, 0}, yawed(0.5), 0.02}, yawed(0.2)), 0.3, 1e-12);
  EXPECT_NEAR(yaw_error({{10, 0, 0}, yawed(3.1), 0.02}, yawed(-3.1)), 2 * M_PI - 6.2, 1e-12);
  const Pose pitched = yawed(0.2) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY());
  EXPECT_NEAR(yaw_error({{10, 0, 0}, yawed(0.2), 0.02}, pitched), 0, 1e-12);
}

TEST(ObjectError, of_velocity_is_the_missed_displacement_over_time) {
  const ReferenceMotion object{{10, 0, 0}, Pose(Eigen::Translation3d(1, 0, 0)), 0.02};
  EXPECT_NEAR(velocity_error(object, Pose(Eigen::Translation3d(1.3, 0.4, 0)), 0.1), 5, 1e-12);
  EXPECT_THROW(static_cast<void>(velocity_error(object, Pose::Identity(), -0.1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
