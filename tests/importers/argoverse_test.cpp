// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "argoverse_layout.h"
#include "io/test_folder.h"
#include "log_checks.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

fs::path log_folder(const TestFolder& folder) { return folder.path() / "log"; }

ToolResult import_log(const TestFolder& folder, const std::string& more = "") {
  return run(std::string(ARGOVERSE2RAWLOG) + " --log " + log_folder(folder).string() +
             " --output " + folder / "out.rawlog" + " --overwrite " + more);
}

ToolResult import_with_labels(const TestFolder& folder) {
  return import_log(
      folder, "--boxes " + folder / "boxes.csv" + " --truth-objects " + folder / "x_objects.csv");
}

// Every ring is one beam of one LiDAR, from the lowest up.
void expect_ring_per_beam(const LidarScan& scan, const ArgoverseLog::Sweep& sweep) {
  EXPECT_EQ(scan.num_rings, 64);
  ASSERT_EQ(scan.ring.size(), scan.size());
  std::map<int, std::set<int>> beams_of_ring;
  for (std::size_t k = 0; k < scan.size(); ++k) beams_of_ring[scan.ring[k]].insert(sweep.beam[k]);
  EXPECT_GT(beams_of_ring.size(), 50U);
  double last = -M_PI;
  for (const auto& [ring, beams] : beams_of_ring) {
    EXPECT_EQ(beams.size(), 1U) << "ring " << ring;
    const double elevation = mounted_elevation(*beams.begin());
    EXPECT_GE(elevation, last) << "ring " << ring;
    last = elevation;
  }
}

TEST(ArgoverseLayout, sweeps_come_back_in_the_upper_lidars_frame_with_their_rings) {
  const TestFolder folder;
  const ArgoverseLog written(log_folder(folder));
  const ToolResult result = import_log(folder);
  ASSERT_EQ(result.status, 0) << result.text;
  const ImportedLog log = read_imported(folder / "out.rawlog");
  ASSERT_EQ(log.scans.size(), kNumFrames);
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    const LidarScan& scan = log.scans[i];
    const ArgoverseLog::Sweep& sweep = written.sweeps[i];
    EXPECT_EQ(scan.label, "LIDAR");
    EXPECT_EQ(scan.stamp, frame_stamp(i));
    expect_near(scan.T_vehicle_lidar, written.T_vehicle_up, 1e-9);
    ASSERT_EQ(scan.size(), sweep.points.size());
    ASSERT_EQ(scan.intensity.size(), scan.size());
    double worst = 0;
    for (std::size_t k = 0; k < scan.size(); ++k) {
      const Eigen::Vector3d in_vehicle = scan.T_vehicle_lidar * scan.points[k].cast<double>();
      worst = std::max(worst, (in_vehicle - sweep.points[k]).norm());
      ASSERT_NEAR(255 * scan.intensity[k], sweep.intensity[k], 1e-3);
    }
    EXPECT_LT(worst, 3e-5);
    expect_ring_per_beam(scan, sweep);
  }
}

TEST(ArgoverseLayout, pictures_and_poses_come_back_at_30_hz) {
  const TestFolder folder;
  const ArgoverseLog written(log_folder(folder));
  ASSERT_EQ(import_log(folder).status, 0);
  const ImportedLog log = read_imported(folder / "out.rawlog");
  ASSERT_EQ(log.images.size(), written.pictures.size());
  for (std::size_t i = 0; i < log.images.size(); ++i) {
    EXPECT_EQ(log.images[i].stamp, written.pictures[i]);
    expect_same_camera(log.images[i].camera, written.street.camera.camera);
    cv::Mat difference;
    cv::absdiff(log.images[i].bgr, written.street.picture(written.pictures[i]).image.bgr,
                difference);
    EXPECT_LT(cv::mean(difference)[1], 6);  // what JPEG leaves of the noise
  }
  ASSERT_EQ(log.poses.size(), kNumFrames + written.pictures.size());
  for (std::size_t i = 0; i < log.poses.size(); ++i) {
    EXPECT_EQ(log.pose_labels[i], "POSES");
    expect_near(log.poses[i].T_world_vehicle,
                written.T_city_world * written.street.T_world_vehicle(log.poses[i].stamp), 1e-6);
  }
}

TEST(ArgoverseLayout, annotations_become_truth_tables_and_boxes) {
  const TestFolder folder;
  const ArgoverseLog written(log_folder(folder));
  const ToolResult result = import_with_labels(folder);
  ASSERT_EQ(result.status, 0) << result.text;
  const std::vector<int> ids = written.street.ids();
  std::map<int, int> track_of_object;
  for (int n = 0; n < static_cast<int>(ids.size()); ++n) track_of_object[ids[n]] = n;
  const TruthRows rows = read_truth_table(folder / "x_objects.csv");
  EXPECT_EQ(rows.size(), kNumFrames * ids.size());
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    expect_objects_true(rows, written.street, frame_stamp(i), frame_stamp(i), written.T_city_world,
                        track_of_object);
  }
  for (const auto& [key, row] : read_truth_table(folder / "x_ego.csv")) {
    const Stamp stamp{mrpt::Clock::duration(key.first)};
    expect_near(pose_in(row), written.T_city_world * written.street.T_world_vehicle(stamp), 1e-6);
  }
  expect_boxes_fit(folder / "boxes.csv", written.street, written.pictures, written.pictures,
                   "ring_front_center", track_of_object);
}

TEST(ArgoverseLayout, what_is_missing_or_broken_is_named) {
  const TestFolder folder;
  const ArgoverseLog written(log_folder(folder));
  const auto expect_failure = [&](const ToolResult& result, const std::string& why) {
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.text, why)) << result.text;
    EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
    EXPECT_FALSE(fs::exists(folder / "x_objects.csv"));
  };
  expect_failure(import_log(folder, "--cameras ring_rear_left"), "ring_rear_left");
  const fs::path labels = log_folder(folder) / "per_sweep_annotations_amodal";
  const fs::path first = fs::directory_iterator(labels)->path();
  std::ofstream(first) << R"([{"track_label_uuid": "a", "label_class": "BUS"}])";
  expect_failure(import_with_labels(folder), first.filename().string());
  fs::remove_all(labels);
  expect_failure(import_with_labels(folder), "per_sweep_annotations_amodal");
  const fs::path sweep = fs::directory_iterator(log_folder(folder) / "lidar")->path();
  fs::resize_file(sweep, fs::file_size(sweep) / 2);
  expect_failure(import_log(folder), sweep.filename().string());
  std::ofstream(log_folder(folder) / "vehicle_calibration_info.json") << "{";
  expect_failure(import_log(folder), "vehicle_calibration_info.json");
}

}  // namespace
}  // namespace lidar_upsampling
