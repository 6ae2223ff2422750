// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

World traffic() {
  World world = empty_world();
  world.ego.motion.speed = 9;
  world.ego.pitch_sway = 0.01;
  add_vehicle(world, "car", {12, 3, 3, 0, 8, {{0, -2, 0.5}}});
  add_vehicle(world, "truck", {25, -4, 0.1, 0, 12, {}});
  add_vehicle(world, "pedestrian", {9, -3, 1.5, 0, 1.5, {}});
  return world;
}

TEST(Lidar, every_point_lies_on_the_surface_of_what_it_hit) {
  const World world = traffic();
  const LidarSpec lidar = test_lidar();
  const Stamp stamp = stamp_of(7, 10, 0);
  const SimulatedScan scan = scan_at(world, lidar, stamp, 1);
  const Pose T_world_lidar = world.T_world_vehicle(time_of(stamp)) * lidar.T_vehicle_lidar;
  ASSERT_GT(scan.scan.size(), 40000U);
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const Eigen::Vector3d p = T_world_lidar * scan.scan.points[i].cast<double>();
    ASSERT_NEAR(distance_to(world, scan.object[i], time_of(stamp), p), 0, 5e-5) << i;
  }
}

TEST(Lidar, ranges_scatter_by_the_noise_asked_for) {
  const World world = traffic();
  const Stamp stamp = stamp_of(0, 10, 0);
  const LidarScan exact = scan_at(world, test_lidar(0), stamp, 1).scan;
  const LidarScan noisy = scan_at(world, test_lidar(0.02), stamp, 1).scan;
  ASSERT_EQ(exact.size(), noisy.size());
  double sum = 0, sq_sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error = noisy.points[i].norm() - exact.points[i].norm();
    sum += error;
    sq_sum += error * error;
  }
  const auto n = static_cast<double>(exact.size());
  EXPECT_NEAR(sum / n, 0, 4 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(sq_sum / n), 0.02, 4e-4);
}

TEST(Lidar, a_car_behind_a_truck_has_no_returns) {
  World world = empty_world();
  add_vehicle(world, "truck", {12, 0, M_PI / 2, 0, 0, {}});
  const int hidden = add_vehicle(world, "car", {20, 0, 0, 0, 0, {}});
  const Stamp stamp = start_stamp();
  EXPECT_EQ(num_points_of(scan_at(world, test_lidar(), stamp, 1), hidden), 0);
  world.objects[1].motion.x = 500;
  EXPECT_GT(num_points_of(scan_at(world, test_lidar(), stamp, 1), hidden), 200);
}

TEST(Lidar, the_same_seed_gives_the_same_scan_on_any_number_of_threads) {
  const World world = traffic();
  const LidarSpec lidar = test_lidar(0.02);
  const LidarScan many = scan_at(world, lidar, stamp_of(1, 10, 0), 5).scan;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LidarScan single = scan_at(world, lidar, stamp_of(1, 10, 0), 5).scan;
  EXPECT_EQ(many.points, single.points);
  EXPECT_EQ(many.intensity, single.intensity);
  const LidarScan other = scan_at(world, lidar, stamp_of(1, 10, 0), 6).scan;
  EXPECT_NE(many.points, other.points);
}

TEST(Lidar, the_true_motion_takes_points_onto_the_object_at_another_time) {
  const World world = traffic();
  const LidarSpec lidar = test_lidar();
  const Stamp key = stamp_of(2, 10, 0), now = stamp_of(8, 30, 0);
  const SimulatedScan scan = scan_at(world, lidar, key, 1);
  const Pose T_world_lidar = world.T_world_vehicle(time_of(key)) * lidar.T_vehicle_lidar;
  int moved = 0;
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const int id = scan.object[i];
    if (!world.objects[id].moves()) continue;
    const Pose T_now_key =
        world.T_world_object(id, time_of(now)) * world.T_world_object(id, time_of(key)).inverse();
    const Eigen::Vector3d p = T_now_key * T_world_lidar * scan.scan.points[i].cast<double>();
    ASSERT_NEAR(distance_to(world, id, time_of(now), p), 0, 5e-5);
    ++moved;
  }
  EXPECT_GT(moved, 1000);
}

TEST(Lidar, rings_count_from_the_lowest_and_columns_run_clockwise) {
  const World world = empty_world();
  const SimulatedScan simulated = scan_at(world, test_lidar(), start_stamp(), 1);
  const LidarScan& scan = simulated.scan;
  EXPECT_EQ(scan.num_rings, 64);
  EXPECT_EQ(scan.num_columns, 1900);
  for (std::size_t i = 1; i < scan.size(); ++i) {
    if (scan.column[i] == scan.column[i - 1]) {
      ASSERT_GT(scan.ring[i], scan.ring[i - 1]);
      ASSERT_GT(scan.points[i].head<2>().norm(), scan.points[i - 1].head<2>().norm());
    } else {
      ASSERT_GT(scan.column[i], scan.column[i - 1]);
    }
  }
  const auto left = std::find(scan.column.begin(), scan.column.end(), 1900 * 3 / 4);
  ASSERT_NE(left, scan.column.end());
  EXPECT_LT(scan.points[left - scan.column.begin()].y(), -1);  // three quarters round: on the right
}

TEST(Lidar, a_sweep_measures_each_column_at_its_own_instant) {
  const World world = traffic();
  LidarSpec lidar = test_lidar();
  lidar.sweep = true;
  lidar.columns = 600;
  const Stamp stamp = stamp_of(7, 10, 0);
  const SimulatedScan sweep = scan_at(world, lidar, stamp, 1);
  ASSERT_EQ(sweep.scan.time_s.size(), sweep.scan.size());
  double farthest_off = 0;
  for (std::size_t i = 0; i < sweep.scan.size(); ++i) {
    const double time = sweep_time(lidar, sweep.scan.column[i]);
    ASSERT_FLOAT_EQ(sweep.scan.time_s[i], static_cast<float>(time));
    ASSERT_LT(std::abs(time), 0.05);
    const double t = time_of(stamp) + time;
    const Eigen::Vector3d measured = sweep.scan.points[i].cast<double>();
    const Eigen::Vector3d p = world.T_world_vehicle(t) * lidar.T_vehicle_lidar * measured;
    ASSERT_NEAR(distance_to(world, sweep.object[i], t, p), 0, 5e-5) << i;
    const Pose T_world_vehicle = world.T_world_vehicle(time_of(stamp));
    const Eigen::Vector3d as_if_at_once = T_world_vehicle * lidar.T_vehicle_lidar * measured;
    farthest_off = std::max(farthest_off, (p - as_if_at_once).norm());
  }
  EXPECT_GT(farthest_off, 0.4);  // half a turn at 9 m/s
  EXPECT_LT(sweep_time(lidar, 0), -0.049);
  EXPECT_NEAR(sweep_time(lidar, 300), 0, 1e-4);  // it faces forward
}

TEST(Lidar, plates_shine_and_tyres_do_not) {
  World world = empty_world();
  const int car = add_vehicle(world, "car", {9, 0, 0, 0, 0, {}});
  const SimulatedScan simulated = scan_at(world, test_lidar(), start_stamp(), 1);
  float brightest = 0, dullest = 1;
  for (std::size_t i = 0; i < simulated.scan.size(); ++i) {
    ASSERT_GE(simulated.scan.intensity[i], 0);
    ASSERT_LE(simulated.scan.intensity[i], 1);
    if (simulated.object[i] != car) continue;
    brightest = std::max(brightest, simulated.scan.intensity[i]);
    dullest = std::min(dullest, simulated.scan.intensity[i]);
  }
  EXPECT_GT(brightest, 0.85F);
  EXPECT_LT(dullest, 0.15F);
}

}  // namespace
}  // namespace lidar_upsampling::sim
