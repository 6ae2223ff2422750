// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <map>
#include <optional>
#include <sstream>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "rawlog-map-compare/voxel_set.h"
#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

/// The tool's table: by its first column, the numbers of the others.
std::map<std::string, std::vector<double>> table(const std::string& text) {
  std::map<std::string, std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line, name, bar; std::getline(lines, line);) {
    std::istringstream cells(line);
    if (!(cells >> bar >> name >> bar)) continue;
    std::string cell;
    while (cells >> cell)
      if (std::isdigit(static_cast<unsigned char>(cell[0])) != 0)
        rows[name].push_back(std::stod(cell));
  }
  return rows;
}

enum Column { real, virtual_scans, voxels, seen, ghosts, others };

std::string compare_command(const TestFolder& folder) {
  return std::string(RAWLOG_MAP_COMPARE) + " --reference " + folder / "in.rawlog" +
         " --truth-objects " + folder / "in_objects.csv";
}

class MapCompare : public testing::Test {
 protected:
  void thin() {
    expect_done(std::string(RAWLOG_DECIMATE) + " --input " + folder_ / "in.rawlog" + " --output " +
                folder_ / "thin.rawlog" + " --label LIDAR --keep-every 4");
  }
  void densify_thin(const std::string& name, const std::string& more) {
    expect_done(densify_command(folder_ / "thin.rawlog", folder_ / name + ".rawlog", more));
  }
  std::map<std::string, std::vector<double>> compare(const std::string& arguments) {
    const ToolResult result = run(compare_command(folder_) + " --input " + arguments);
    EXPECT_EQ(result.status, 0) << result.text;
    return table(result.text);
  }
  TestFolder folder_;
};

TEST_F(MapCompare, the_reference_covers_itself_and_has_ghosts_of_what_moves) {
  simulate(folder_);
  const auto rows = compare(folder_ / "in.rawlog");
  ASSERT_EQ(rows.at("in").size(), 6U);
  EXPECT_EQ(rows.at("in")[real], 5);
  EXPECT_EQ(rows.at("in")[virtual_scans], 0);
  EXPECT_EQ(rows.at("in")[seen], 100);
  EXPECT_GT(rows.at("in")[ghosts], 20);
  EXPECT_LT(rows.at("in")[others], 0.001 * rows.at("in")[voxels]);
}

TEST_F(MapCompare, fewer_scans_see_less_and_moving_objects_dropped_leave_fewer_ghosts) {
  simulate(folder_);
  thin();
  densify_thin("keep", "");
  densify_thin("drop", "--set objects=drop");
  const auto rows = compare(folder_ / "thin.rawlog" + " " + folder_ / "keep.rawlog" + " " +
                            folder_ / "drop.rawlog");
  EXPECT_EQ(rows.at("thin")[real], 2);
  EXPECT_LT(rows.at("thin")[seen], 90);
  EXPECT_GE(rows.at("keep")[virtual_scans], 8);
  EXPECT_GE(rows.at("keep")[seen], rows.at("thin")[seen]);
  EXPECT_GT(rows.at("keep")[ghosts], 1.2 * rows.at("thin")[ghosts]);
  EXPECT_LT(rows.at("drop")[ghosts], 0.9 * rows.at("keep")[ghosts]);
}

TEST_F(MapCompare, tells_how_far_a_slam_programs_path_is_off) {
  if (!is_installed("rbpf-slam")) GTEST_SKIP() << "rbpf-slam is not installed";
  simulate(folder_, "[log]\nformat = sensory_frames\n");
  expect_done("cd " + folder_.path().string() +
              " && rbpf-slam " CONFIG_FOLDER "/rbpf-slam.ini in.rawlog");
  const ToolResult result = run(compare_command(folder_) + " --simplemap " +
                                file_ending_in(folder_.path(), ".simplemap"));
  ASSERT_EQ(result.status, 0) << result.text;
  const auto row = table(result.text).at("_finalmap_");
  ASSERT_EQ(row.size(), 6U) << result.text;
  EXPECT_EQ(row[0], 5);            // real scans
  EXPECT_NEAR(row[2], 3.2, 0.05);  // of the true way
  EXPECT_GT(row[4], 0);            // the odometry's noise, at the end
  EXPECT_LT(row[4], 0.3);
  // Of a reference that ends before the path does, what it reaches is judged.
  RawlogReader reader(folder_ / "in.rawlog");
  RawlogWriter writer(folder_ / "start.rawlog", false);
  std::optional<Stamp> first;
  while (const auto entry = reader.next()) {
    const auto stamp = stamp_of(*entry);
    if (!first) first = stamp;
    if (!stamp || seconds_between(*first, *stamp) < 0.25) writer.write(*entry);
  }
  writer.commit();
  const ToolResult of_start =
      run(std::string(RAWLOG_MAP_COMPARE) + " --reference " + folder_ / "start.rawlog" +
          " --simplemap " + file_ending_in(folder_.path(), ".simplemap") + " 2>&1");
  ASSERT_EQ(of_start.status, 0) << of_start.text;
  EXPECT_TRUE(contains(of_start.text, "left out of the errors: ")) << of_start.text;
  EXPECT_LT(table(of_start.text).at("_finalmap_")[2], 2.7);
}

TEST_F(MapCompare, nothing_to_compare_is_wrong_usage) {
  EXPECT_EQ(run(compare_command(folder_)).status, 2);
}

TEST(VoxelSet, finds_points_in_a_voxel_and_beside_it) {
  VoxelSet voxels(0.2);
  voxels.insert({-0.1, 0.1, 5.1});
  voxels.insert({-0.15, 0.05, 5.05});
  EXPECT_EQ(voxels.size(), 1U);
  EXPECT_TRUE(voxels.contains({-0.19, 0.19, 5.01}));
  EXPECT_FALSE(voxels.contains({0.1, 0.1, 5.1}));
  EXPECT_TRUE(voxels.has_near({0.1, 0.3, 5.3}));
  EXPECT_FALSE(voxels.has_near({0.3, 0.1, 5.1}));
  voxels.for_each_center([](const Eigen::Vector3d& center) {
    EXPECT_TRUE(center.isApprox(Eigen::Vector3d(-0.1, 0.1, 5.1), 1e-9));
  });
}

}  // namespace
}  // namespace lidar_upsampling
