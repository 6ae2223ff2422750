// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

constexpr const char* kWalkingPace = R"(
[ego]
speed_mps = 1
[vehicle.lead]
x_m = 9
speed_mps = 1
[log]
format = )";

void densified_depth_log(const TestFolder& folder, const std::string& format,
                         const std::string& carrier) {
  simulate(folder, kWalkingPace + format + "\n", kDepthCamera);
  densify(folder, "--set carrier=" + carrier);
}

// Of the carrier of the virtual scans.
class DepthCamera : public testing::TestWithParam<std::string> {
 protected:
  // Runs icp-slam, or another, on a log of the folder; leaves what it makes in `folder`/`program`.
  std::string run_slam(const std::string& program, const std::string& log) {
    std::string place = folder_ / program;
    expect_done("mkdir " + place + " && cd " + place + " && " + program + " " CONFIG_FOLDER "/" +
                program + ".ini " + folder_ / log);
    return place;
  }
  TestFolder folder_;
};

constexpr std::size_t kRealScans = 5;

/// What the folder's map is made of: its virtual scans, and nothing of the real ones.
void expect_map_of_virtual_scans_only(const std::string& folder) {
  const auto scans = scans_in_simplemap(file_ending_in(folder, ".simplemap"));
  EXPECT_EQ(with_label(scans, "DEPTH").size(), kRealScans);
  EXPECT_TRUE(placed(with_label(scans, "DEPTH"), Placing::by_pose).empty());
  const auto virtual_scans = with_label(scans, "DEPTH_VIRTUAL");
  EXPECT_EQ(virtual_scans.size(), kVirtualScans);
  const auto map = read_points(file_ending_in(folder, "CSimplePointsMap_00.txt"));
  const auto expected = placed(virtual_scans, Placing::as_this_mrpt_does);
  EXPECT_LT(difference(extent(map), extent(expected)), 0.3);
  EXPECT_GT(share_found(map, expected, 0.1), 0.99);
  EXPECT_GT(share_found(expected, map, 0.1), 0.99);
}

TEST_P(DepthCamera, icp_slam_maps_virtual_scans_and_silently_leaves_out_range_pictures) {
  if (!is_installed("icp-slam")) GTEST_SKIP() << "icp-slam is not installed";
  densified_depth_log(folder_, "observations", GetParam());
  expect_map_of_virtual_scans_only(run_slam("icp-slam", "out.rawlog"));
}

TEST_P(DepthCamera, rbpf_slam_and_observations2map_do_the_same) {
  if (!is_installed("rbpf-slam")) GTEST_SKIP() << "rbpf-slam is not installed";
  densified_depth_log(folder_, "sensory_frames", GetParam());
  const std::string place = run_slam("rbpf-slam", "out.rawlog");
  expect_map_of_virtual_scans_only(place);
  const std::string simplemap = file_ending_in(place, ".simplemap");
  expect_done("observations2map " CONFIG_FOLDER "/observations2map.ini " + simplemap + " " +
              folder_ / "map");
  const auto map = read_points(folder_ / "map_mrpt__maps__CSimplePointsMap_00.txt");
  const auto expected = placed(scans_in_simplemap(simplemap), Placing::as_this_mrpt_does);
  EXPECT_LT(difference(extent(map), extent(expected)), 0.1);
  EXPECT_GT(share_found(map, expected, kRounding_m), 0.999);
}

// The way out for maps: points in place of the range pictures.
TEST_P(DepthCamera, with_points_generated_by_rawlog_edit_real_scans_are_mapped_too) {
  if (!is_installed("icp-slam")) GTEST_SKIP() << "icp-slam is not installed";
  densified_depth_log(folder_, "observations", GetParam());
  expect_done("rawlog-edit --generate-3d-pointclouds -i " + folder_ / "out.rawlog" + " -o " +
              folder_ / "points.rawlog");
  const std::string place = run_slam("icp-slam", "points.rawlog");
  const auto scans = scans_in_simplemap(file_ending_in(place, ".simplemap"));
  const auto real = placed(with_label(scans, "DEPTH"), Placing::as_this_mrpt_does);
  const auto map = read_points(file_ending_in(place, "CSimplePointsMap_00.txt"));
  EXPECT_GT(real.size(), 1000U * kRealScans);
  EXPECT_GT(share_found(real, map, 0.05), 0.99);
}

INSTANTIATE_TEST_SUITE_P(Carriers, DepthCamera,
                         testing::Values("auto", "3drangescan", "pointcloud"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
