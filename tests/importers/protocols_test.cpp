// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <filesystem>

#include "argoverse_layout.h"
#include "io/test_folder.h"
#include "kitti_layouts.h"
#include "tools/run_tool.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// The scripts of share/protocols on data sets of a few simulated frames, in the real ones' layout.
class ProtocolScript : public testing::Test {
 protected:
  [[nodiscard]] std::string table(const std::string& script, const std::string& arguments) const {
    const ToolResult result = run("env BUILD=" BUILD_FOLDER " OUT=" + folder_ / "out" +
                                  " bash " PROTOCOLS_FOLDER "/" + script + ".sh " + arguments);
    EXPECT_EQ(result.status, 0) << result.text;
    return result.text;
  }

  [[nodiscard]] std::string data() const { return (folder_.path() / "data").string(); }

  TestFolder folder_;
};

void expect_rows(const std::string& table, const std::string& heading) {
  EXPECT_TRUE(contains(table, heading)) << table;
  for (const char* row : {"hold", "ego", "constant-velocity", "paper", "ours", "oracle"})
    EXPECT_TRUE(contains(table, "\n  " + std::string(row))) << row << '\n' << table;
  EXPECT_TRUE(contains(table, "as published")) << table;
}

TEST_F(ProtocolScript, kitti_odometry_prints_the_table_of_scenes_and_of_vehicles) {
  write_sequence(data(), SmallStreet());
  expect_rows(table("kitti-odometry", data() + " 04"), "protocol kitti-odometry");
  const std::string vehicles = table("kitti-vehicles", data() + " 04");
  expect_rows(vehicles, "protocol kitti-vehicles");
  EXPECT_TRUE(contains(vehicles, "ours, without outliers"));
}

TEST_F(ProtocolScript, kitti_raw_trajectories_prints_depth_errors_by_labelled_object) {
  const fs::path day = fs::path(data()) / "2011_09_26";
  const fs::path drive = write_drive(day, SmallStreet());
  for (const char* number : {"0004", "0047"})
    fs::copy(drive, day / ("2011_09_26_drive_" + std::string(number) + "_sync"),
             fs::copy_options::recursive);
  const std::string printed = table("kitti-raw-trajectories", day.string() + " 0004 0047");
  EXPECT_TRUE(contains(printed, "protocol kitti-raw-trajectories: depth error, %")) << printed;
  EXPECT_TRUE(contains(printed, "object 04/")) << printed;
  EXPECT_TRUE(contains(printed, "object 47/")) << printed;
  EXPECT_TRUE(contains(printed, "as published")) << printed;
}

TEST_F(ProtocolScript, argoverse_prints_the_table_of_scenes_and_of_vehicles) {
  const ArgoverseLog written(fs::path(data()) / "log1");
  expect_rows(table("argoverse", data()), "protocol argoverse");
  expect_rows(table("argoverse-vehicles", data() + " log1"), "protocol argoverse-vehicles");
}

TEST_F(ProtocolScript, running_time_prints_the_papers_components) {
  const fs::path drive = write_drive(fs::path(data()) / "2011_09_26", SmallStreet());
  const std::string printed = table("running-time", drive.string());
  EXPECT_TRUE(contains(printed, "composition")) << printed;
  EXPECT_TRUE(contains(printed, "726")) << printed;  // PointINet's, as published
}

TEST_F(ProtocolScript, a_folder_that_is_not_there_is_named) {
  const ToolResult result = run("env BUILD=" BUILD_FOLDER " OUT=" + folder_ / "out" +
                                " bash " PROTOCOLS_FOLDER "/kitti-odometry.sh /no/such/folder");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, "/no/such/folder")) << result.text;
}

}  // namespace
}  // namespace lidar_upsampling
