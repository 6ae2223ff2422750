// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "io/test_folder.h"
#include "kitti_layouts.h"
#include "log_checks.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// A drive with labels in place of tracklets, and what becomes of them.
struct LabelledDriveFolder {
  TestFolder folder;
  SmallStreet street;
  fs::path drive = write_drive(folder.path() / "day", street);

  LabelledDriveFolder() {
    fs::remove(drive / "tracklet_labels.xml");
    write_labels(label_02_text(street));
  }

  void write_labels(const std::string& text) const { std::ofstream(label_file()) << text; }
  [[nodiscard]] fs::path label_file() const { return drive / "label_02.txt"; }
  [[nodiscard]] std::string command(const std::string& more = "") const {
    return std::string(KITTI2RAWLOG) + " --drive " + drive.string() + " --overwrite --output " +
           folder / "out.rawlog" + " --boxes " + folder / "boxes.csv" + " --truth-objects " +
           folder / "x_objects.csv" + " " + more;
  }

  [[nodiscard]] fs::path oxts_file(int frame) const {
    return drive / ("oxts/data/000000000" + std::to_string(frame) + ".txt");
  }

  void expect_refused(const std::string& why, const std::string& more = "") const {
    const ToolResult result = run_for_errors(command(more));
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
    EXPECT_TRUE(contains(result.text, why)) << result.text;
    for (const char* const name : {"out.rawlog", "boxes.csv", "x_objects.csv", "x_ignored.csv"}) {
      EXPECT_FALSE(fs::exists(folder / name)) << name;
    }
  }
  void expect_warning(const std::string& what) const {
    const ToolResult result = run_for_errors(command());
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
    EXPECT_TRUE(contains(result.text, "warning: " + label_file().string() + ": " + what))
        << result.text;
  }
  [[nodiscard]] std::map<int, int> track_of_object() const {
    std::map<int, int> tracks;
    for (const int id : street.ids()) {
      tracks[id] = kFirstLabelTrack + static_cast<int>(tracks.size());
    }
    return tracks;
  }
};

std::string content_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string without_rows(const std::string& labels, const std::string& frame) {
  std::istringstream in(labels);
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(frame + " ", 0) != 0) kept += line + "\n";
  }
  return kept;
}

TEST(KittiLabels, become_truth_tables_and_boxes) {
  const LabelledDriveFolder labelled;
  const ToolResult result = run_for_errors(labelled.command());
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_EQ(result.text, "");
  const TruthRows rows = read_truth_table(labelled.folder / "x_objects.csv");
  const std::map<int, int> tracks = labelled.track_of_object();
  EXPECT_EQ(rows.size(), kNumFrames * tracks.size());
  std::vector<Stamp> pictures;
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    expect_objects_true(rows, labelled.street, frame_stamp(i), frame_stamp(i),
                        T_drive_world(labelled.street), tracks);
    pictures.push_back(drive_picture_stamp(i));
  }
  expect_boxes_fit(labelled.folder / "boxes.csv", labelled.street, pictures, pictures, "CAM2",
                   tracks);
}

TEST(KittiLabels, areas_that_nobody_labelled_are_in_a_table_that_is_there_for_such_labels_only) {
  const LabelledDriveFolder labelled;
  ASSERT_EQ(run(labelled.command()).status, 0);
  std::string expected = "stamp,camera,left,top,right,bottom\n";
  for (const int frame : {0, 2}) {
    expected += std::to_string(frame_stamp(frame).time_since_epoch().count()) +
                ",CAM2,10.50,20.00,30.00,40.25\n";
  }
  EXPECT_EQ(content_of(labelled.folder / "x_ignored.csv"), expected);

  std::string others = label_02_text(labelled.street);
  for (std::size_t at = 0; (at = others.find("-1 DontCare")) != std::string::npos;) {
    others.erase(others.rfind('\n', at) + 1, others.find('\n', at) - others.rfind('\n', at));
  }
  labelled.write_labels(others);
  ASSERT_EQ(run(labelled.command()).status, 0);
  EXPECT_FALSE(fs::exists(labelled.folder / "x_ignored.csv"));
}

TEST(KittiLabels, come_from_the_file_that_is_named_rather_than_from_the_drive) {
  const LabelledDriveFolder labelled;
  const std::string other = labelled.folder / "other.txt";
  std::ofstream(other) << without_rows(label_02_text(labelled.street), "0");
  labelled.write_labels("broken");
  ASSERT_EQ(run(labelled.command("--labels " + other)).status, 0);
  EXPECT_EQ(read_truth_table(labelled.folder / "x_objects.csv").size(),
            (kNumFrames - 1) * labelled.street.ids().size());
  EXPECT_EQ(run(labelled.command("--labels " + labelled.folder / "none.txt")).status, 2);
}

TEST(KittiLabels, that_are_wrong_are_refused_in_one_line) {
  const LabelledDriveFolder labelled;
  const std::string row = "1 3 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5";
  labelled.write_labels("");
  labelled.expect_refused("label_02.txt holds no labels");
  labelled.write_labels(row + "\n" + "2 3 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9\n");
  labelled.expect_refused("label_02.txt, line 2: 16 columns instead of 17");
  labelled.write_labels("Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n");
  labelled.expect_refused("label_2");
  labelled.write_labels("\n1 3 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 nan 9 0.5\n");
  labelled.expect_refused("line 2: 'nan' is no number");
  labelled.write_labels("1.5 3 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n");
  labelled.expect_refused("line 1: '1.5' is no whole number");
  labelled.write_labels("1 3 Car 0 0 -1.5 1 2 3 4 1.5 0 4.2 2 1.7 9 0.5\n");
  labelled.expect_refused("line 1: a box without extent");
  labelled.write_labels(row + "\n" + row + "\n");
  labelled.expect_refused("line 2: track 3 is already labelled in frame 1");
  labelled.write_labels("90" + row + "\n");
  labelled.expect_refused("no labelled frame (901 to 901) is among the scans' (0 to 3)");
}

TEST(KittiLabels, without_poses_are_refused) {
  const LabelledDriveFolder labelled;
  fs::remove_all(labelled.drive / "oxts");
  labelled.expect_refused("no oxts");
}

TEST(KittiLabels, that_do_not_cover_the_drive_are_counted) {
  const LabelledDriveFolder labelled;
  const std::string labels = label_02_text(labelled.street);
  labelled.write_labels(without_rows(labels, "3"));
  labelled.expect_warning("1 of 4 scans (3 to 3) have no label, as if nothing was there");
  labelled.write_labels("-2 5 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n" + labels +
                        "12 5 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n");
  labelled.expect_warning("2 of 6 labelled frames (-2 to 12) have no scan: left out");
}

TEST(KittiLabels, of_frames_without_a_pose_are_counted) {
  const LabelledDriveFolder labelled;
  // One pose tells no motion to carry on with.
  for (int i = 1; i < kNumFrames; ++i) fs::remove(labelled.oxts_file(i));
  const ToolResult result = run_for_errors(labelled.command());
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.text, "3 of 4 labelled frames (1 to 3) have no pose of the vehicle"))
      << result.text;
  EXPECT_EQ(read_truth_table(labelled.folder / "x_objects.csv").size(),
            labelled.street.ids().size());
}

TEST(KittiLabels, are_refused_where_no_frame_has_a_pose) {
  const LabelledDriveFolder labelled;
  for (int i = 0; i + 1 < kNumFrames; ++i) fs::remove(labelled.oxts_file(i));
  fs::remove(labelled.drive / "velodyne_points/data/0000000003.bin");
  const ToolResult result = run_for_errors(labelled.command());
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, "no labelled frame has a pose of the vehicle")) << result.text;
  EXPECT_FALSE(fs::exists(labelled.folder / "x_objects.csv"));
}

TEST(KittiLabels, that_jump_are_left_out_and_counted) {
  const LabelledDriveFolder labelled;
  std::string labels = label_02_text(labelled.street);
  labels +=
      "0 99 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n"
      "1 99 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n"
      "2 99 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 59 0.5\n"
      "3 99 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4.2 2 1.7 9 0.5\n";
  labelled.write_labels(labels);
  const ToolResult result = run_for_errors(labelled.command());
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.text, "1 object with labels that jump")) << result.text;
  EXPECT_EQ(read_truth_table(labelled.folder / "x_objects.csv").size(),
            kNumFrames * labelled.street.ids().size() + 3);
}

}  // namespace
}  // namespace lidar_upsampling
