// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/maps/CSimpleMap.h>

#include <filesystem>
#include <sstream>

#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

// The one .simplemap below the folder; empty if there is none.
std::string simple_map_in(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".simplemap") return entry.path().string();
  return {};
}

int num_frames_with(const mrpt::maps::CSimpleMap& map, const std::string& label) {
  int num_frames = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    mrpt::poses::CPose3DPDF::ConstPtr pose;
    mrpt::obs::CSensoryFrame::ConstPtr frame;
    map.get(i, pose, frame);
    if (frame->getObservationBySensorLabel(label)) ++num_frames;
  }
  return num_frames;
}

// Images and poses make no map, which icp-slam remarks; of scans it must not.
bool scans_made_the_map(const std::string& output) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (contains(line, "No map was updated") &&
        (contains(line, "CObservation3DRangeScan") || contains(line, "CObservationPointCloud")))
      return false;
  return true;
}

class IcpSlam : public testing::TestWithParam<std::string> {};

TEST_P(IcpSlam, stock_icp_slam_maps_the_virtual_scans) {
  if (run("command -v icp-slam").status != 0) GTEST_SKIP() << "icp-slam is not installed";
  const TestFolder folder;
  simulate(folder, "[log]\nformat = " + GetParam() + "\n");
  densify(folder);
  const ToolResult result = run("cd " + folder.path().string() +
                                " && icp-slam " CONFIG_FOLDER "/icp-slam.ini out.rawlog");
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(scans_made_the_map(result.text)) << result.text;

  const std::string path = simple_map_in(folder.path());
  ASSERT_FALSE(path.empty()) << result.text;
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(path));
  EXPECT_GE(num_frames_with(map, "LIDAR"), 2);
  EXPECT_GE(num_frames_with(map, "LIDAR_VIRTUAL"), 4);
}

INSTANTIATE_TEST_SUITE_P(Formats, IcpSlam, testing::Values("observations", "sensory_frames"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
