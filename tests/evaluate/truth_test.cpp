// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "truth.h"

#include <gtest/gtest.h>

#include <fstream>

#include "evaluate/stamps.h"
#include "io/test_folder.h"

namespace lidar_upsampling {
namespace {

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

/// The crossing's scan at 0.1 s, straightened, whose points were met 40 ms after its stamp: by then
/// the car has gone 0.2 m.
LidarScan late_scan() {
  LidarScan scan;
  scan.stamp = at(0.1);
  scan.points = {{30, 5, 0}, {19, 0.7F, 0}};
  scan.time_s = {0, 0.04F};
  return scan;
}

TEST(BroughtTo, what_a_sweep_met_after_its_stamp_moves_on_from_then) {
  const LidarScan later = brought_to(crossing(), late_scan(), at(0.15));
  EXPECT_LT((later.points[1] - Eigen::Vector3f(18.5F, 0.75F, 0)).norm(), 1e-4);
}

TEST(BroughtTo, the_stamp_of_a_sweep_is_an_instant_like_others) {
  const LidarScan at_stamp = brought_to(crossing(), late_scan(), at(0.1));
  EXPECT_LT((at_stamp.points[0] - Eigen::Vector3f(30, 5, 0)).norm(), 1e-4);
  EXPECT_LT((at_stamp.points[1] - Eigen::Vector3f(19, 0.5F, 0)).norm(), 1e-4);
}

TEST(BoxAsSeen, of_a_sweep_is_where_the_object_was_when_it_was_met) {
  const Truth truth = crossing();
  const Eigen::Vector3d met = late_scan().points[1].cast<double>();
  const auto seen = box_as_seen(truth, truth.objects[0], late_scan());
  const auto at_stamp = box_in_scan(truth, truth.objects[0], late_scan());
  ASSERT_TRUE(seen && at_stamp);
  EXPECT_NEAR((*seen * met).y(), 0, 1e-4);
  EXPECT_NEAR((*at_stamp * met).y(), 0.2, 1e-4);
}

TEST(BroughtTo, beyond_the_truth_the_scan_stays_as_it_is) {
  LidarScan scan;
  scan.stamp = at(0.1);
  scan.points = {{30, 5, 0}};
  const LidarScan later = brought_to(crossing(), scan, at(3));
  EXPECT_EQ(later.stamp, at(0.1));
  EXPECT_EQ(later.points[0], scan.points[0]);
}

/// A user's own table: a car at 5 m/s whose labels jitter by a decimetre, ten a second.
class OwnTable : public ::testing::Test {
 protected:
  OwnTable() {
    write("_ego.csv", "stamp,x,y,z,yaw\n0,0,0,0,0\n20000000,20,0,0,0\n");
    std::string rows = "stamp,id,class,x,y,z,yaw,length,width,height\n";
    for (int i = 0; i <= 10; ++i)
      rows += std::to_string(1'000'000 * i) + ",7,car," +
              std::to_string(0.5 * i + (i % 2 == 0 ? 0.05 : -0.05)) + ",3,0,0,4,2,1.5\n";
    write("_objects.csv", rows);
  }

  void write(const std::string& ending, const std::string& text) {
    std::ofstream(folder_ / ("own" + ending)) << text;
  }
  [[nodiscard]] Truth load() const { return load_truth(folder_ / "own_objects.csv"); }
  [[nodiscard]] std::string complaint() const {
    try {
      static_cast<void>(load());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  TestFolder folder_;
};

TEST_F(OwnTable, without_velocities_they_are_fitted_to_the_boxes_about) {
  const Truth truth = load();
  ASSERT_EQ(truth.objects.size(), 1U);
  const auto velocity = truth.objects[0].velocity_at(Stamp(Stamp::duration(5'000'000)));
  ASSERT_TRUE(velocity);
  EXPECT_NEAR(velocity->x(), 5, 0.1);
  EXPECT_TRUE(truth.objects[0].moves_at(Stamp(Stamp::duration(5'000'000))));
}

TEST_F(OwnTable, beyond_its_labels_an_object_has_no_velocity) {
  EXPECT_FALSE(load().objects[0].velocity_at(Stamp(Stamp::duration(12'000'000))));
}

TEST_F(OwnTable, areas_that_nobody_labelled_are_read_where_there_are_any) {
  EXPECT_TRUE(load().ignored.empty());
  write("_ignored.csv", "stamp,camera,left,top,right,bottom\n0,CAM2,1,2,3,4\n");
  const Truth truth = load();
  ASSERT_EQ(truth.ignored.size(), 1U);
  EXPECT_EQ(truth.ignored.begin()->second.camera, "CAM2");
  EXPECT_EQ(truth.ignored.begin()->second.box.right, 3);
}

TEST_F(OwnTable, a_track_that_jumps_tells_no_velocity_there_and_is_warned_of) {
  std::string rows = "stamp,id,class,x,y,z,yaw,length,width,height\n";
  for (int i = 0; i <= 20; ++i)
    rows += std::to_string(1'000'000 * i) + ",7,car," + std::to_string(0.5 * i) + "," +
            (i < 10 ? "3" : "30") + ",0,0,4,2,1.5\n";
  write("_objects.csv", rows);
  const Truth truth = load();
  ASSERT_EQ(truth.warnings.size(), 1U);
  EXPECT_NE(truth.warnings[0].find("labels of 1 objects jump 1 times"), std::string::npos);
  for (const auto& [stamp, velocity] : truth.objects[0].velocity)
    EXPECT_LT(velocity.norm(), 6) << stamp.time_since_epoch().count();
  EXPECT_FALSE(truth.objects[0].velocity.empty());
}

TEST_F(OwnTable, wrong_ones_are_told_in_a_line_that_names_the_file) {
  write("_ego.csv", "stamp,x,y,z,yaw\n");
  EXPECT_NE(complaint().find("own_ego.csv: holds no pose"), std::string::npos) << complaint();
  write("_ego.csv", "stamp,x,y,z,yaw\n0,0,0,0,0\n");
  write("_objects.csv", "");
  EXPECT_NE(complaint().find("own_objects.csv: cannot be read, or is empty"), std::string::npos);
  write("_objects.csv", "stamp,id,class,x,y,z,yaw,length,width,height\n");
  EXPECT_NE(complaint().find("holds no labelled object"), std::string::npos) << complaint();
  write("_objects.csv", "stamp,id,class,x,y,z,yaw,length,width,height\n0,7,car,0,0,0,0,4,0,1.5\n");
  EXPECT_NE(complaint().find("box without extent"), std::string::npos) << complaint();
}

}  // namespace
}  // namespace lidar_upsampling
