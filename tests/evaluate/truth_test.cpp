// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "truth.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

Stamp at(double seconds) { return shifted(Stamp{}, 100 + seconds); }

Pose moved_by(double x, double y) { return Pose(Eigen::Translation3d(x, y, 0)); }

/// The vehicle drives at 10 m/s along x, a car ahead of it at 5 m/s across.
Truth crossing() {
  Truth truth;
  truth.T_world_vehicle = Trajectory(InterpolationLimits{0.25, 0});
  TrueObject car;
  car.id = "7";
  car.size = {4, 2, 1.5};
  car.T_world_object = Trajectory(InterpolationLimits{0.25, 0});
  for (const double t : {0., 0.1, 0.2}) {
    truth.T_world_vehicle.add({at(t), moved_by(10 * t, 0)});
    car.T_world_object.add({at(t), moved_by(20, 5 * t)});
    car.moving[at(t)] = true;
  }
  truth.objects.push_back(car);
  return truth;
}

TEST(BroughtTo, the_scene_moves_by_the_ego_motion_and_an_object_by_its_own_as_well) {
  LidarScan scan;
  scan.stamp = at(0.1);
  scan.points = {{30, 5, 0}, {19, 0.5F, 0}};  // the car's middle is at (19, 0.5) seen from here
  const LidarScan later = brought_to(crossing(), scan, at(0.12));
  EXPECT_EQ(later.stamp, at(0.12));
  EXPECT_LT((later.points[0] - Eigen::Vector3f(29.8F, 5, 0)).norm(), 1e-4);
  EXPECT_LT((later.points[1] - Eigen::Vector3f(18.8F, 0.6F, 0)).norm(), 1e-4);
}

TEST(BroughtTo, beyond_the_truth_the_scan_stays_as_it_is) {
  LidarScan scan;
  scan.stamp = at(0.1);
  scan.points = {{30, 5, 0}};
  const LidarScan later = brought_to(crossing(), scan, at(3));
  EXPECT_EQ(later.stamp, at(0.1));
  EXPECT_EQ(later.points[0], scan.points[0]);
}

}  // namespace
}  // namespace lidar_upsampling
