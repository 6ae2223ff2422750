// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/pose_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "io/test_folder.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {
namespace {

const Stamp kStart = parse_stamp("1317046450");

// Straight on along world x, then a quarter turn to the left.
Pose quarter_turn_at(double x) {
  Pose T = Pose::Identity();
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T.translation() = Eigen::Vector3d(x, 2, 3);
  return T;
}

class PoseFile : public ::testing::Test {
 protected:
  std::string file(const std::string& text, const std::string& name = "poses") {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::vector<PoseSample> read(const PoseFileOptions& options,
                                      const std::vector<Stamp>& scans = {},
                                      const Pose& T_vehicle_sensor = Pose::Identity()) {
    return read_pose_file(options, scans, T_vehicle_sensor);
  }
  static PoseFileOptions at(const std::string& path) {
    PoseFileOptions options;
    options.path = path;
    return options;
  }
  std::string error_of(const std::string& text, const std::vector<Stamp>& scans = {}) {
    try {
      (void)read(at(file(text)), scans);
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).erase(0, (folder_ / "poses").size());
    }
    return "no error";
  }

 private:
  TestFolder folder_;
};

void expect_quarter_turn(const std::vector<PoseSample>& samples) {
  ASSERT_EQ(samples.size(), 2);
  EXPECT_EQ(samples[0].stamp, kStart);
  EXPECT_EQ(samples[1].stamp, shifted(kStart, 0.1));
  EXPECT_TRUE(samples[0].T_world_vehicle.isApprox(Pose::Identity(), 1e-6));
  EXPECT_TRUE(samples[1].T_world_vehicle.isApprox(quarter_turn_at(1), 1e-6))
      << samples[1].T_world_vehicle.matrix();
}

TEST_F(PoseFile, of_tum_is_read_with_its_comments) {
  expect_quarter_turn(
      read(at(file("# t x y z qx qy qz qw\n\n1317046450.0 0 0 0 0 0 0 1\n"
                   "1317046450.1 1 2 3 0 0 0.70710678 0.70710678 # turned\n"))));
}

TEST_F(PoseFile, of_tum_may_have_times_with_exponents_and_loses_no_tick) {
  const auto samples = read(at(file("1.317046450123456700e+09 0 0 0 0 0 0 1\n")));
  EXPECT_EQ(samples.at(0).stamp, parse_stamp("1317046450.1234567"));
}

TEST_F(PoseFile, of_kitti_has_a_pose_per_scan) {
  expect_quarter_turn(read(at(file("1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 1 1 0 0 2 0 0 1 3\n")),
                           {kStart, shifted(kStart, 0.1)}));
}

TEST_F(PoseFile, of_kitti_may_have_a_file_of_times_from_the_first_scan_on) {
  PoseFileOptions options = at(file("1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 1 1 0 0 2 0 0 1 3\n"));
  options.times = file("0.000000e+00\n1.000000e-01\n", "times");
  expect_quarter_turn(read(options, {kStart}));
  options.times = file("1317046450\n1317046450.1\n", "times");
  expect_quarter_turn(read(options, {shifted(kStart, 5)}));
}

TEST_F(PoseFile, of_csv_is_read_by_its_columns_names) {
  expect_quarter_turn(
      read(at(file("y,x,z,stamp,yaw,pitch,roll,note\n0,0,0,1317046450,0,0,0,a\n"
                   "2,1,3,1317046450.1,1.57079633,0,0,b\n"))));
  expect_quarter_turn(
      read(at(file("stamp, x, y, z, qx, qy, qz, qw\n1317046450,0,0,0,0,0,0,1\n"
                   "1317046450.1,1,2,3,0,0,0.70710678,0.70710678\r\n"))));
}

TEST_F(PoseFile, of_csv_may_be_as_spreadsheets_write_it) {
  expect_quarter_turn(
      read(at(file("\xEF\xBB\xBFstamp , x, y, z, yaw, pitch, roll, note\n"
                   "1317046450,0,0,0,0,0,0,\n"
                   "1317046450.1,1,2,3,1.57079633,0,0,turned\n"))));
}

TEST_F(PoseFile, angles_of_csv_turn_about_z_then_y_then_x) {
  const auto samples = read(at(file("stamp,x,y,z,yaw,pitch,roll\n1,0,0,0,0.3,0.2,0.1\n")));
  const Eigen::Matrix3d expected = (Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  EXPECT_TRUE(samples.at(0).T_world_vehicle.linear().isApprox(expected, 1e-12));
}

TEST_F(PoseFile, poses_of_a_sensor_become_those_of_the_vehicle) {
  Pose T_vehicle_sensor = Pose::Identity();
  T_vehicle_sensor.translation().x() = 1;
  const auto samples = read(at(file("1317046450 5 0 0 0 0 0 1\n"
                                    "1317046450.1 5 0 0 0 0 0.70710678 0.70710678\n")),
                            {}, T_vehicle_sensor);
  EXPECT_TRUE(samples.at(0).T_world_vehicle.translation().isApprox(Eigen::Vector3d(4, 0, 0)));
  EXPECT_TRUE(
      samples.at(1).T_world_vehicle.translation().isApprox(Eigen::Vector3d(5, -1, 0), 1e-6));
}

TEST_F(PoseFile, what_is_wrong_is_named_with_its_line) {
  const std::string good = "1317046450 0 0 0 0 0 0 1\n";
  EXPECT_EQ(error_of(good + "\n1317046451 0 0 x 0 0 0 1\n"),
            ", line 3: 'x' is no number; expected t x y z qx qy qz qw");
  EXPECT_EQ(error_of(good + "1317046451 0 0 0\n"),
            ", line 2: 4 numbers; expected t x y z qx qy qz qw");
  EXPECT_EQ(error_of("1317046450 0 0 0 0 0 0 0.3\n"),
            ", line 1: the quaternion's norm is 0.300000, not 1: no rotation; expected t x y z qx "
            "qy qz qw");
  EXPECT_EQ(error_of("2 0 0 0 0 1 0 0 0 0 1 0\n", {kStart}),
            ", line 1: the first three columns are no rotation; expected the 12 numbers of a 3x4 "
            "matrix, row by row");
  EXPECT_EQ(error_of("1 2 3\n"),
            ", line 1: 3 numbers; expected 8 (tum), 12 (kitti), or a header with commas (csv)");
  EXPECT_EQ(error_of("stamp,x,y,z,yaw,pitch,roll\n\n1,0,0,0,none,0,0\n"),
            ", line 3, column yaw: 'none' is no number");
  EXPECT_EQ(error_of("stamp,x,y,z,yaw,pitch,roll\nsoon,0,0,0,0,0,0\n"),
            ", line 2, column stamp: stamp 'soon' is neither MRPT ticks nor UNIX seconds");
  EXPECT_EQ(error_of("stamp,x,y,z\n1,0,0,0\n"),
            ": the header names neither yaw,pitch,roll nor qx,qy,qz,qw; expected stamp,x,y,z and "
            "one of them");
  EXPECT_EQ(error_of("# nothing\n"), ": holds no poses");
  const std::string no_text = ", line 1: this is no table in text";
  EXPECT_EQ(error_of(std::string("\x1f\x8b\x08\0\n", 5)), no_text);
  EXPECT_EQ(error_of(std::string(100000, '1')), no_text);
}

TEST_F(PoseFile, of_kitti_that_fits_neither_scans_nor_times_says_so) {
  EXPECT_EQ(error_of("1 0 0 0 0 1 0 0 0 0 1 0\n", {kStart, shifted(kStart, 1)}),
            ": 1 poses, but 2 scans in the log: a file of times is needed ([ego_motion] "
            "poses_times)");
}

TEST(StampText, is_read_back_to_the_tick) {
  for (const char* text : {"1317046450.1234567", "1317046450.0000001", "0.5000000"})
    EXPECT_EQ(to_text(parse_stamp(text)), text);
}

}  // namespace
}  // namespace lidar_upsampling
