// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <map>

#include "depth_observation.h"
#include "lidar_upsampling/io/carriers.h"
#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

LidarSpec depth_camera() {
  LidarSpec spec;
  spec.label = "DEPTH";
  CameraModel model;
  model.width = 160;
  model.height = 120;
  model.fx = model.fy = 145;
  model.cx = 80.25;
  model.cy = 58.5;
  spec.depth_camera = model;
  spec.columns = model.width;
  spec.noise_m = spec.dropout = 0;
  spec.min_range_m = 0.3;
  spec.max_range_m = 20;
  spec.T_vehicle_lidar.translation() << 1, 0.1, 1.2;
  return spec;
}

World car_ahead() {
  World world = empty_world();
  add_vehicle(world, "car", {8, 0.5, 0.3, 0, 0, {}});
  return world;
}

TEST(DepthCamera, a_point_lies_on_the_ray_of_its_pixel) {
  const LidarSpec spec = depth_camera();
  const World world = car_ahead();
  const SimulatedScan simulated = scan_at(world, spec, start_stamp(), 1);
  const LidarScan& scan = simulated.scan;
  EXPECT_EQ(scan.num_rings, 120);
  EXPECT_EQ(scan.num_columns, 160);
  ASSERT_GT(scan.size(), 8000U);
  EXPECT_GT(num_points_of(simulated, 1), 1000);
  const CameraModel& m = *spec.depth_camera;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    ASSERT_NEAR(m.cx - m.fx * p.y() / p.x(), scan.column[i], 1e-3);
    ASSERT_NEAR(m.cy - m.fy * p.z() / p.x(), 119 - scan.ring[i], 1e-3);
    ASSERT_NEAR(distance_to(world, simulated.object[i], 0, spec.T_vehicle_lidar * p.cast<double>()),
                0, 5e-5);
    ASSERT_LE(p.norm(), 20.F);
  }
}

TEST(DepthCamera, noise_grows_with_the_square_of_the_range) {
  LidarSpec spec = depth_camera();
  const LidarScan exact = scan_at(car_ahead(), spec, start_stamp(), 1).scan;
  spec.noise_m = 0.002;
  spec.noise_per_m2 = 0.001;
  const LidarScan noisy = scan_at(car_ahead(), spec, start_stamp(), 1).scan;
  ASSERT_EQ(exact.size(), noisy.size());
  double sq_sum = 0, nearest = 100, farthest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double range = exact.points[i].norm();
    const double error = (noisy.points[i].norm() - range) / (0.002 + 0.001 * range * range);
    sq_sum += error * error;
    nearest = std::min(nearest, range);
    farthest = std::max(farthest, range);
  }
  EXPECT_NEAR(std::sqrt(sq_sum / static_cast<double>(exact.size())), 1, 0.03);
  EXPECT_GT(farthest, 4 * nearest);
}

TEST(DepthCamera, its_observation_is_a_range_picture_from_which_the_points_come_back) {
  const LidarSpec spec = depth_camera();
  const LidarScan scan = scan_at(car_ahead(), spec, start_stamp(), 1).scan;
  const auto observation = depth_observation(scan, spec);
  EXPECT_TRUE(observation->hasRangeImage);
  EXPECT_FALSE(observation->hasPoints3D);
  EXPECT_TRUE(observation->range_is_depth);
  EXPECT_EQ(observation->rangeImage.rows(), 120);
  EXPECT_EQ(observation->cameraParams.fx(), 145);
  const LidarScan read = scan_from_observation(*observation).value();
  EXPECT_EQ(read.label, "DEPTH");
  EXPECT_EQ(read.stamp, scan.stamp);
  EXPECT_TRUE(read.T_vehicle_lidar.isApprox(spec.T_vehicle_lidar));
  ASSERT_EQ(read.size(), scan.size());
  // The picture goes row by row from the top, the simulated scan column by column.
  std::map<std::pair<int, int>, Eigen::Vector3f> simulated;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    simulated[{scan.ring[i], scan.column[i]}] = scan.points[i];
  }
  for (std::size_t i = 0; i < read.size(); ++i) {
    const Eigen::Vector3f& p = simulated.at({read.ring[i], read.column[i]});
    ASSERT_LT((read.points[i] - p).norm(), 6e-4 * p.norm() / p.x() + 1e-5);
  }
}

}  // namespace
}  // namespace lidar_upsampling::sim
