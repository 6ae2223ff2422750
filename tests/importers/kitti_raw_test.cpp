// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "io/test_folder.h"
#include "kitti_layouts.h"
#include "log_checks.h"
#include "simulator/truth.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

std::string command(const fs::path& drive, const TestFolder& folder) {
  return std::string(KITTI2RAWLOG) + " --drive " + drive.string() + " --output " +
         folder / "out.rawlog";
}

std::string label_options(const TestFolder& folder) {
  return " --boxes " + folder / "boxes.csv" + " --truth-objects " + folder / "x_objects.csv";
}

std::string header_of(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line + "\n";
}

void expect_columns_of_the_simulator(const TestFolder& folder) {
  std::ostringstream objects, ego, boxes;
  sim::write_objects_header(objects);
  sim::write_ego_header(ego);
  sim::write_boxes_header(boxes);
  EXPECT_EQ(header_of(folder / "x_objects.csv"), objects.str());
  EXPECT_EQ(header_of(folder / "x_ego.csv"), ego.str());
  EXPECT_EQ(header_of(folder / "boxes.csv"), boxes.str());
}

TEST(KittiRawLayout, scans_images_and_poses_come_back) {
  const TestFolder folder;
  const SmallStreet street;
  const ToolResult result = run(command(write_drive(folder.path() / "day", street), folder));
  ASSERT_EQ(result.status, 0) << result.text;
  const ImportedLog log = read_imported(folder / "out.rawlog");
  ASSERT_EQ(log.scans.size(), kNumFrames);
  ASSERT_EQ(log.images.size(), kNumFrames);
  ASSERT_EQ(log.poses.size(), kNumFrames);
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(log.scans[i].stamp, frame_stamp(i));
    EXPECT_EQ(log.scans[i].label, "LIDAR");
    EXPECT_EQ(log.scans[i].points, kitti_points(street, frame_stamp(i)).points);
    EXPECT_EQ(log.scans[i].ring.size(), log.scans[i].size());
    expect_near(log.scans[i].T_vehicle_lidar, street.lidar.T_vehicle_lidar, 1e-6);
    EXPECT_EQ(log.images[i].stamp, drive_picture_stamp(i));
    expect_same_camera(log.images[i].camera, street.camera.camera);
    const cv::Mat expected = street.picture(drive_picture_stamp(i)).image.bgr;
    EXPECT_EQ(cv::norm(log.images[i].bgr, expected, cv::NORM_INF), 0);
    EXPECT_EQ(log.poses[i].stamp, drive_oxts_stamp(i));
    EXPECT_EQ(log.pose_labels[i], "OXTS");
    expect_near(log.poses[i].T_world_vehicle,
                T_drive_world(street) * street.T_world_vehicle(drive_oxts_stamp(i)), 1e-5);
  }
}

TEST(KittiRawLayout, tracklets_become_truth_tables) {
  const TestFolder folder;
  const SmallStreet street;
  const fs::path drive = write_drive(folder.path() / "day", street);
  const ToolResult result = run(command(drive, folder) + label_options(folder));
  ASSERT_EQ(result.status, 0) << result.text;
  expect_columns_of_the_simulator(folder);
  const TruthRows rows = read_truth_table(folder / "x_objects.csv");
  const std::vector<int> ids = street.ids();
  ASSERT_GE(ids.size(), 5U);
  EXPECT_EQ(rows.size(), kNumFrames * ids.size() - 1);  // one appears a frame late
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    std::map<int, int> track_of_object;
    for (int n = 0; n < static_cast<int>(ids.size()); ++n) {
      if (i >= first_labelled_frame(n)) track_of_object[ids[n]] = n;
    }
    expect_objects_true(rows, street, frame_stamp(i), frame_stamp(i), T_drive_world(street),
                        track_of_object);
  }
  const TruthRows ego = read_truth_table(folder / "x_ego.csv");
  EXPECT_EQ(ego.size(), 2U * kNumFrames);  // at scans and pictures
  for (const auto& [key, row] : ego) {
    const Stamp stamp{mrpt::Clock::duration(key.first)};
    expect_near(pose_in(row), T_drive_world(street) * street.T_world_vehicle(stamp), 5e-3);
  }
}

TEST(KittiRawLayout, tracklets_become_boxes_about_what_the_pictures_show) {
  const TestFolder folder;
  const SmallStreet street;
  const fs::path drive = write_drive(folder.path() / "day", street);
  ASSERT_EQ(run(command(drive, folder) + label_options(folder)).status, 0);
  const std::vector<int> ids = street.ids();
  std::map<int, int> track_of_object;
  // The first is occluded in one frame, the second not yet labelled in another.
  for (int n = 2; n < static_cast<int>(ids.size()); ++n) track_of_object[ids[n]] = n;
  std::vector<Stamp> stamps(kNumFrames);
  for (int i = 0; i < kNumFrames; ++i) stamps[i] = drive_picture_stamp(i);
  expect_boxes_fit(folder / "boxes.csv", street, stamps, stamps, "CAM2", track_of_object);
}

TEST(KittiRawLayout, labels_without_oxts_or_tracklets_are_refused_in_one_line) {
  const TestFolder folder;
  const SmallStreet street;
  const fs::path drive = write_drive(folder.path() / "day", street);
  fs::remove_all(drive / "oxts");
  const auto expect_refused = [&](const std::string& why) {
    const ToolResult result = run_for_errors(command(drive, folder) + label_options(folder));
    EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
    EXPECT_TRUE(contains(result.text, why)) << result.text;
    for (const char* const name : {"out.rawlog", "boxes.csv", "x_objects.csv", "x_ego.csv"}) {
      EXPECT_FALSE(fs::exists(folder / name)) << name;
    }
  };
  expect_refused("no oxts");
  fs::remove(drive / "tracklet_labels.xml");
  expect_refused("tracklet_labels.xml");
  EXPECT_EQ(run(command(drive, folder)).status, 0);  // the log alone needs neither
}

TEST(KittiRawLayout, tracklets_that_are_none_are_refused_in_one_line) {
  const TestFolder folder;
  const fs::path drive = write_drive(folder.path() / "day", SmallStreet());
  std::ifstream whole(drive / "tracklet_labels.xml");
  const std::string good{std::istreambuf_iterator<char>(whole), {}};
  const std::string tag = "<first_frame>";
  const auto expect_refused = [&](const std::string& xml, const std::string& why) {
    std::ofstream(drive / "tracklet_labels.xml") << xml;
    const ToolResult result = run_for_errors(command(drive, folder) + label_options(folder));
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
    EXPECT_TRUE(contains(result.text, why)) << result.text;
  };
  ASSERT_NE(good.find(tag), std::string::npos);
  expect_refused("<!-- none -->\n", "hold nothing");
  expect_refused("<?xml version=\"1.0\"?><boost_serialization/>", "no <tracklets>");
  expect_refused(std::string(good).insert(good.find(tag) + tag.size(), "9e99"), "first_frame");
}

}  // namespace
}  // namespace lidar_upsampling
