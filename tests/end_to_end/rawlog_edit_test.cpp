// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationImage.h>

#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

struct EditedLog {
  std::string name;
  std::string changes;  ///< of the street
  std::string carrier, output_class;
  std::string label = "LIDAR_VIRTUAL";
  std::string lidar = kSmallLidar;  ///< the street's
};

void PrintTo(const EditedLog& log, std::ostream* out) { *out << log.name; }

class RawlogEdit : public testing::TestWithParam<EditedLog> {};

void expect_counted(const EditedLog& log, const std::string& path) {
  const ToolResult info = run("rawlog-edit --info -i " + path);
  EXPECT_EQ(info.status, 0);
  EXPECT_TRUE(contains(info.text, log.label + " /      " + std::to_string(kVirtualScans) + " /"))
      << info.text;
}

void expect_described(const EditedLog& log, const std::string& path) {
  const ToolResult description = run("rawlog-edit --describe -i " + path);
  EXPECT_EQ(description.status, 0);
  EXPECT_EQ(count_of(description.text,
                     "Sensor label: '" + log.label + "'\n\nClassName: " + log.output_class + "\n"),
            kVirtualScans);
}

void expect_same_but_for_pictures(const std::vector<Logged>& back, const std::vector<Logged>& in) {
  ASSERT_EQ(back.size(), in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    EXPECT_EQ(back[i].label(), in[i].label()) << i;
    EXPECT_EQ(back[i].stamp(), in[i].stamp()) << i;
    // MRPT writes colour pictures as JPEG.
    if (dynamic_cast<mrpt::obs::CObservationImage*>(in[i].observation.get()) != nullptr) continue;
    EXPECT_TRUE(back[i].bytes == in[i].bytes) << i;
  }
}

TEST_P(RawlogEdit, counts_describes_and_removes_the_virtual_scans_and_nothing_else) {
  if (!has_rawlog_edit()) GTEST_SKIP() << "rawlog-edit is not installed";
  const EditedLog& log = GetParam();
  const TestFolder folder;
  simulate(folder, log.changes, log.lidar);
  densify(folder, "--set carrier=" + log.carrier);
  expect_counted(log, folder / "out.rawlog");
  expect_described(log, folder / "out.rawlog");
  if (!rawlog_edit_removes_labels(folder / "out.rawlog", folder / "pictures.rawlog"))
    GTEST_SKIP() << "this MRPT's rawlog-edit removes nothing";
  expect_done("rawlog-edit --remove-label " + log.label + " -i " + folder / "out.rawlog" + " -o " +
              folder / "back.rawlog");
  expect_same_but_for_pictures(observations_of(folder / "back.rawlog"),
                               observations_of(folder / "in.rawlog"));
}

const std::string kRangeScanClass = "mrpt::obs::CObservation3DRangeScan";
const std::string kPointCloudClass = "mrpt::obs::CObservationPointCloud";
const std::string kFrames = "[log]\nformat = sensory_frames\n";

INSTANTIATE_TEST_SUITE_P(
    Logs, RawlogEdit,
    testing::Values(EditedLog{"range_scans", "", "3drangescan", kRangeScanClass},
                    EditedLog{"point_clouds", "", "pointcloud", kPointCloudClass},
                    EditedLog{"range_scans_in_frames", kFrames, "3drangescan", kRangeScanClass},
                    EditedLog{"point_clouds_in_frames", kFrames, "pointcloud", kPointCloudClass},
                    EditedLog{"range_scans_of_a_depth_camera", "", "3drangescan", kRangeScanClass,
                              "DEPTH_VIRTUAL", kDepthCamera},
                    EditedLog{"point_clouds_of_a_depth_camera", "", "pointcloud", kPointCloudClass,
                              "DEPTH_VIRTUAL", kDepthCamera}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lidar_upsampling
