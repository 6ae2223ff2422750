// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include "clouds.h"

namespace lidar_upsampling {
namespace {

/// A car's points 10 m ahead and 1.5 m above a lattice of ground, all in the lidar frame.
LidarScan small_scan(double car_x, Stamp stamp) {
  LidarScan scan;
  scan.stamp = stamp;
  for (int i = 0; i < 40; ++i)
    for (int j = -20; j < 20; ++j)
      scan.points.emplace_back(2 + 0.5F * static_cast<float>(i), 0.5F * static_cast<float>(j),
                               -1.8F);
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      scan.points.emplace_back(static_cast<float>(car_x), 0.15F * static_cast<float>(i) - 0.7F,
                               0.15F * static_cast<float>(j) - 1.3F);
  return scan;
}

class Samples : public ::testing::Test {
 protected:
  Samples() {
    ObjectResult car;
    car.object.class_name = "car";
    for (int i = 1600; i < 1700; ++i) car.object.points.push_back(i);
    car.object.moving = true;
    car.estimates[Row::hold] = car.estimates[Row::ego] = Pose::Identity();
    car.estimates[Row::ours] = car.estimates[Row::oracle] = Pose(Eigen::Translation3d(1, 0, 0));
    result_.objects.push_back(car);
    options_.num_seeds = 2;
    clouds_[Row::floor] = reference_.points;
    clouds_[Row::hold] = key_.points;
    clouds_[Row::ours] = reference_.points;
  }

  void measure(const std::string& protocol) {
    options_.protocol = find_protocol(protocol);
    measure_samples(clouds_, {key_, reference_, reference_}, {}, options_, result_);
  }

  LidarScan key_ = small_scan(10, Stamp{});
  LidarScan reference_ = small_scan(11, shifted(Stamp{}, 0.1));
  EvaluationOptions options_;
  PerRow<Points> clouds_;
  ScanResult result_;
};

TEST_F(Samples, a_vehicle_put_where_it_is_costs_nothing_one_left_behind_its_step) {
  measure("argoverse-vehicles");
  ASSERT_EQ(result_.sampled[Row::ours].all.size(), 2U);
  EXPECT_NEAR(result_.sampled[Row::ours].all[0].chamfer.sum_sq_m2(), 0, 1e-9);
  EXPECT_NEAR(result_.sampled[Row::hold].all[0].chamfer.mean_m(), 1, 1e-3);
  EXPECT_NEAR(result_.sampled[Row::hold].all[0].emd.squared_m2, 1, 0.1);
}

TEST_F(Samples, outliers_are_the_same_points_for_every_row) {
  // Ten more points that the reference scan does not show.
  for (int i = 0; i < 10; ++i) {
    key_.points.emplace_back(10.F, 5.F, 0.1F * static_cast<float>(i));
    result_.objects[0].object.points.push_back(static_cast<int>(key_.points.size()) - 1);
  }
  measure("kitti-vehicles");
  const auto& hold = result_.sampled[Row::hold];
  const auto& ours = result_.sampled[Row::ours];
  EXPECT_GT(ours.all[0].chamfer.mean_m(), 0.05);
  EXPECT_NEAR(ours.inliers[0].chamfer.mean_m(), 0, 1e-6);
  EXPECT_NEAR(hold.inliers[0].chamfer.mean_m(), 1, 1e-3);
}

TEST_F(Samples, scenes_without_a_candidate_are_left_out) {
  result_.objects.clear();
  measure("kitti-odometry");
  EXPECT_TRUE(result_.sampled[Row::ours].all.empty());
}

TEST_F(Samples, the_floor_of_a_scene_is_what_sampling_alone_costs) {
  options_.protocol = find_protocol("kitti-odometry");
  options_.protocol->num_points = 800;
  measure_samples(clouds_, {key_, reference_, reference_}, {}, options_, result_);
  const auto& floor = result_.sampled[Row::floor].all;
  ASSERT_EQ(floor.size(), 2U);
  EXPECT_GT(floor[0].chamfer.sum_sq_m2(), 0);
  // Ours is the reference scan itself here, so it is drawn like the floor.
  EXPECT_EQ(floor[0].chamfer.sum_sq_m2(), result_.sampled[Row::ours].all[0].chamfer.sum_sq_m2());
}

}  // namespace
}  // namespace lidar_upsampling
