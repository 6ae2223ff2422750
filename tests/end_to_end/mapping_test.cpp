// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

// Whatever of it a program may choose: of the odometry's noise, over 3 m.
constexpr double kDrift_m = 0.3;

std::string points_file(const std::string& folder) {
  return file_ending_in(folder, "CSimplePointsMap_00.txt");
}

/// A densified log of sensory frames, and the folder that rbpf-slam works in. Of the carrier of the
/// virtual scans.
class Mapping : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!is_installed("rbpf-slam")) GTEST_SKIP() << "rbpf-slam is not installed";
    simulate(folder_, std::string(kFewBeams) + "[log]\nformat = sensory_frames\n");
    densify(folder_, "--set carrier=" + GetParam());
    expect_done("cd " + folder_.path().string() +
                " && rbpf-slam " CONFIG_FOLDER "/rbpf-slam.ini out.rawlog");
    simplemap_ = file_ending_in(folder_.path(), ".simplemap");
    scans_ = scans_in_simplemap(simplemap_);
    ASSERT_FALSE(scans_.empty());
  }

  /// The points map that observations2map makes of the simplemap.
  std::vector<Eigen::Vector3d> map_of_observations2map() {
    expect_done("observations2map " CONFIG_FOLDER "/observations2map.ini " + simplemap_ + " " +
                folder_ / "map");
    return read_points(folder_ / "map_mrpt__maps__CSimplePointsMap_00.txt");
  }

  TestFolder folder_;
  std::string simplemap_;
  std::vector<MappedScan> scans_;
};

TEST_P(Mapping, rbpf_slam_maps_the_virtual_scans_of_a_sensory_frame_log) {
  EXPECT_EQ(with_label(scans_, "LIDAR").size(), 5U);
  EXPECT_EQ(with_label(scans_, "LIDAR_VIRTUAL").size(), 8U);
  const auto map = read_points(points_file(folder_.path()));
  const auto expected = placed(scans_, Placing::as_this_mrpt_does);
  // The simplemap has the mean of the particles' poses, the map one particle's, and far away
  // a little yaw is a long way.
  EXPECT_GT(map.size(), expected.size() / 2);
  EXPECT_LT(difference(extent(map), extent(expected)), 3.);
  EXPECT_GT(share_found(expected, map, kDrift_m), 0.95);
  // The odometry moves the particles.
  const auto last = scans_.back().T_map_vehicle.translation();
  EXPECT_NEAR(last.x(), 3.2, kDrift_m);
  EXPECT_NEAR(last.y(), 0, kDrift_m);
}

TEST_P(Mapping, observations2map_maps_each_scan_at_the_pose_of_the_simplemap) {
  if (!is_installed("observations2map")) GTEST_SKIP() << "observations2map is not installed";
  const auto map = map_of_observations2map();
  const auto expected = placed(scans_, Placing::as_this_mrpt_does);
  EXPECT_LT(difference(extent(map), extent(expected)), 0.1);
  EXPECT_GT(share_found(map, expected, kRounding_m), 0.999);
  EXPECT_GT(share_found(expected, map, 0.05), 0.999);
}

INSTANTIATE_TEST_SUITE_P(Carriers, Mapping, testing::Values("3drangescan", "pointcloud"),
                         [](const auto& test) { return test.param; });

using PointCloudMapping = Mapping;

// Why `carrier = auto` is not pointcloud there.
TEST_P(PointCloudMapping, before_mrpt_2_11_3_leaves_virtual_scans_where_the_vehicle_started) {
  if (!maps_misplace_point_clouds()) GTEST_SKIP() << "this MRPT places them right";
  const auto last = std::vector<MappedScan>{with_label(scans_, "LIDAR_VIRTUAL").back()};
  const auto map = map_of_observations2map();
  EXPECT_GT(share_found(placed(last, Placing::at_origin), map, kRounding_m), 0.999);
  EXPECT_LT(share_found(placed(last, Placing::by_pose), map, kRounding_m), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Carriers, PointCloudMapping, testing::Values("pointcloud"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
