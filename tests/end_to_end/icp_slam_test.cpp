// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <sstream>
#include <tuple>

#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

// Images and poses make no map, which icp-slam remarks; of scans it must not.
bool scans_made_the_map(const std::string& output) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (contains(line, "No map was updated") &&
        (contains(line, "CObservation3DRangeScan") || contains(line, "CObservationPointCloud")))
      return false;
  return true;
}

// Of the format of the log and the carrier of its virtual scans.
class IcpSlam : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(IcpSlam, maps_the_virtual_scans) {
  if (!is_installed("icp-slam")) GTEST_SKIP() << "icp-slam is not installed";
  const auto& [format, carrier] = GetParam();
  const TestFolder folder;
  simulate(folder, std::string(kFewBeams) + "[log]\nformat = " + format + "\n");
  densify(folder, "--set carrier=" + carrier);
  const ToolResult result = run("cd " + folder.path().string() +
                                " && icp-slam " CONFIG_FOLDER "/icp-slam.ini out.rawlog");
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(scans_made_the_map(result.text)) << result.text;

  const auto scans = scans_in_simplemap(file_ending_in(folder.path(), ".simplemap"));
  EXPECT_GE(with_label(scans, "LIDAR").size(), 2U);
  const auto virtual_scans = with_label(scans, "LIDAR_VIRTUAL");
  EXPECT_GE(virtual_scans.size(), 4U);
  const auto map = read_points(file_ending_in(folder.path(), "CSimplePointsMap_00.txt"));
  const auto expected = placed(scans, Placing::as_this_mrpt_does);
  EXPECT_LT(difference(extent(map), extent(expected)), 0.1);
  EXPECT_GT(share_found(map, expected, kRounding_m), 0.999);
  EXPECT_GT(share_found(placed(virtual_scans, Placing::as_this_mrpt_does), map, 0.05), 0.999);
}

INSTANTIATE_TEST_SUITE_P(Logs, IcpSlam,
                         testing::Combine(testing::Values("observations", "sensory_frames"),
                                          testing::Values("3drangescan", "pointcloud")),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + std::get<1>(test.param);
                         });

}  // namespace
}  // namespace lidar_upsampling
