// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "dgp2rawlog/dgp_scene.h"
#include "dgp2rawlog/npz_file.h"
#include "dgp_layout.h"
#include "io/test_folder.h"
#include "lidar_upsampling/types.h"
#include "log_checks.h"
#include "npz_layout.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

std::string dgp_command(const fs::path& scene, const TestFolder& folder,
                        const std::string& more = "") {
  return std::string(DGP2RAWLOG) + " --scene " + scene.string() + " --overwrite --output " +
         folder / "out.rawlog" + " " + more;
}

std::string dgp_labels(const TestFolder& folder) {
  return "--boxes " + folder / "boxes.csv" + " --truth-objects " + folder / "x_objects.csv";
}

void expect_dgp_refused(const fs::path& scene, const TestFolder& folder, const std::string& why,
                        const std::string& more = "") {
  const ToolResult result =
      run_for_errors(dgp_command(scene, folder, dgp_labels(folder) + " " + more));
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
  EXPECT_TRUE(contains(result.text, why)) << result.text;
  EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
  EXPECT_FALSE(fs::exists(folder / "x_objects.csv"));
}

TEST(DgpLayout, scans_images_and_poses_come_back) {
  const TestFolder folder;
  const DgpScene written(folder.path() / "scene");
  const ToolResult result = run(dgp_command(written.folder, folder));
  ASSERT_EQ(result.status, 0) << result.text;
  const ImportedLog log = read_imported(folder / "out.rawlog");
  ASSERT_EQ(log.scans.size(), kNumFrames);
  ASSERT_EQ(log.images.size(), kNumFrames);
  ASSERT_EQ(log.poses.size(), 2U * kNumFrames);
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(log.scans[i].stamp, frame_stamp(i));
    EXPECT_EQ(log.scans[i].label, "LIDAR");
    EXPECT_EQ(log.scans[i].points, written.street.scan(frame_stamp(i)).points);
    expect_near(log.scans[i].T_vehicle_lidar, written.street.lidar.T_vehicle_lidar, 1e-6);
    EXPECT_EQ(log.images[i].stamp, dgp_picture_stamp(i));
    expect_same_camera(log.images[i].camera, written.street.camera.camera);
    const cv::Mat expected = written.street.picture(dgp_picture_stamp(i)).image.bgr;
    EXPECT_EQ(cv::norm(log.images[i].bgr, expected, cv::NORM_INF), 0);
  }
  for (std::size_t i = 0; i < log.poses.size(); ++i) {
    EXPECT_EQ(log.pose_labels[i], "POSE");
    expect_near(log.poses[i].T_world_vehicle, written.street.T_world_vehicle(log.poses[i].stamp),
                1e-6);
  }
}

TEST(DgpLayout, labels_become_truth_tables_and_boxes) {
  const TestFolder folder;
  const DgpScene written(folder.path() / "scene");
  const ToolResult result = run(dgp_command(written.folder, folder, dgp_labels(folder)));
  ASSERT_EQ(result.status, 0) << result.text;
  const TruthRows rows = read_truth_table(folder / "x_objects.csv");
  std::map<int, int> track_of_object;
  for (const int id : written.street.ids()) {
    track_of_object[id] = static_cast<int>(track_of_object.size());
  }
  EXPECT_EQ(rows.size(), kNumFrames * track_of_object.size());
  std::vector<Stamp> pictures;
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    expect_objects_true(rows, written.street, frame_stamp(i), frame_stamp(i), Pose::Identity(),
                        track_of_object);
    pictures.push_back(dgp_picture_stamp(i));
  }
  EXPECT_EQ(read_truth_table(folder / "x_ego.csv").size(), 2U * kNumFrames);
  expect_boxes_fit(folder / "boxes.csv", written.street, pictures, pictures, "CAMERA_01",
                   track_of_object);
  EXPECT_FALSE(fs::exists(folder / "x_ignored.csv"));
}

TEST(DgpLayout, what_is_missing_or_broken_is_named) {
  const TestFolder folder;
  const DgpScene written(folder.path() / "scene");
  expect_dgp_refused(written.folder, folder, "no camera CAMERA_07; there are: CAMERA_01",
                     "--cameras CAMERA_07");
  expect_dgp_refused(folder.path(), folder, "holds 0 files scene_*.json");
  expect_dgp_refused(folder.path() / "nowhere", folder, "there is no folder");

  DgpScene changed = written;
  changed.scene["samples"][1]["datum_keys"][0] = "unknown";
  changed.write_scene();
  expect_dgp_refused(written.folder, folder, "scene_0a.json: no data of key unknown");
  changed = written;
  for (auto& datum : changed.scene["data"]) {
    if (datum["datum"].contains("point_cloud")) datum["datum"]["point_cloud"].erase("annotations");
  }
  changed.write_scene();
  expect_dgp_refused(written.folder, folder, "no 3D boxes");
  std::ofstream(written.scene_file) << "{";
  expect_dgp_refused(written.folder, folder, "scene_0a.json: ");
}

TEST(DgpLayout, wrong_labels_are_named_with_their_file) {
  const TestFolder folder;
  const DgpScene written(folder.path() / "scene");
  std::ifstream in(written.labels(2));
  const nlohmann::json good = nlohmann::json::parse(in);
  const auto expect_refused_with = [&](const auto& change, const std::string& why) {
    nlohmann::json labels = good;
    change(labels["annotations"]);
    std::ofstream(written.labels(2)) << labels;
    expect_dgp_refused(written.folder, folder, written.labels(2).filename().string());
    expect_dgp_refused(written.folder, folder, why);
  };
  expect_refused_with([](auto& all) { all[1] = all[0]; }, "is labelled twice");
  expect_refused_with([](auto& all) { all[0].erase("box"); }, "box");
  expect_refused_with(
      [](auto& all) {
        all[0]["instance_id"] = 1;
        all[0]["box"]["width"] = 0;
      },
      "instance 1 is a box without extent");
  expect_refused_with(
      [](auto& all) {
        all[0]["instance_id"] = 1;
        all[0]["class_id"] = 77;
      },
      "class_id 77 is not in the scene's ontology");
  fs::remove(written.labels(2));
  expect_dgp_refused(written.folder, folder, "cannot read " + written.labels(2).string());
}

TEST(DgpLayout, scans_without_labels_are_counted) {
  const TestFolder folder;
  DgpScene written(folder.path() / "scene");
  written.scene["data"][0]["datum"]["point_cloud"].erase("annotations");
  written.write_scene();
  const ToolResult result = run_for_errors(dgp_command(written.folder, folder, dgp_labels(folder)));
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.text, "1 of 4 scans have no labels")) << result.text;
}

TEST(DgpLayout, times_are_those_in_the_files_names_or_else_the_scenes) {
  const auto seconds = [](const std::string& name, const std::string& time) {
    const auto stamp = dgp::stamp_of("a/" + name, time);
    return stamp ? to_text(*stamp) : "none";
  };
  EXPECT_EQ(seconds("15569195938203752.npz", "x"), "1556919593.8203752");
  EXPECT_EQ(seconds("1556919593820375.npz", "x"), "1556919593.8203750");
  EXPECT_EQ(seconds("1556919593820375249.npz", "x"), "1556919593.8203752");
  EXPECT_EQ(seconds("000000000000000005.npz", "2019-05-03T21:39:53.820375Z"), "1556919593.8203750");
  EXPECT_EQ(seconds("left.png", "1970-01-01T00:00:01Z"), "1.0000000");
  EXPECT_EQ(seconds("left.png", "yesterday"), "none");
  EXPECT_EQ(seconds("left.png", "1970-01-01T00:00:01+02:00"), "none");
}

TEST(DgpSweep, that_is_damaged_is_named) {
  const TestFolder folder;
  const SmallStreet street;
  const LidarScan scan = street.scan(frame_stamp(0));
  const std::string file = folder / "sweep.npz";
  const auto expect_refused = [&](const std::string& why) {
    try {
      static_cast<void>(dgp::read_npz(file));
      ADD_FAILURE() << why;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(contains(error.what(), file) && contains(error.what(), why)) << error.what();
    }
  };
  for (const bool packed : {false, true}) {
    write_npz(file, scan, packed);
    EXPECT_EQ(dgp::read_npz(file).rows(), static_cast<Eigen::Index>(scan.size()));
    fs::resize_file(file, fs::file_size(file) / 2);
    expect_refused("cut off");
  }
  write_npz(file, scan, true);
  {
    std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
    damaged.seekp(300);
    damaged << "something else altogether";
  }
  expect_refused("damaged");
  std::ofstream(file) << "";
  expect_refused("no .npz archive");
}

// The scene's data README: 93 boxes are in all three scans, 18 of them move.
TEST(DdadLabels, tell_of_eighteen_movers) {
  const fs::path data = data_folder() / "ddad_scene_01";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  const TestFolder folder;
  const ToolResult result = run(dgp_command(data, folder, dgp_labels(folder)));
  ASSERT_EQ(result.status, 0) << result.text;
  std::map<int, int> num_labels;
  std::set<int> fast;
  for (const auto& [key, row] : read_truth_table(folder / "x_objects.csv")) {
    ++num_labels[key.second];
    if (row.at("vx").empty()) continue;
    const double speed = std::hypot(std::stod(row.at("vx")), std::stod(row.at("vy")));
    EXPECT_LT(speed, 20);
    EXPECT_EQ(row.at("moving"), speed > 0.5 ? "1" : "0");
    if (speed > 1) fast.insert(key.second);
  }
  int num_tracked = 0, num_movers = 0;
  for (const auto& [id, count] : num_labels) {
    if (count < 3) continue;
    ++num_tracked;
    num_movers += fast.count(id) > 0 ? 1 : 0;
  }
  EXPECT_EQ(num_tracked, 93);
  EXPECT_EQ(num_movers, 18);
}

}  // namespace
}  // namespace lidar_upsampling
