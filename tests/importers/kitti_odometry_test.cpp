// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <fstream>

#include "io/test_folder.h"
#include "kitti_layouts.h"
#include "log_checks.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

ToolResult import_sequence(const fs::path& sequence, const TestFolder& folder,
                           const std::string& more = "") {
  return run(std::string(KITTI2RAWLOG) + " --sequence " + sequence.string() + " --output " +
             folder / "out.rawlog" + " --overwrite " + more);
}

// Times count from the first frame, which is put at 1970-01-01.
Stamp log_stamp(int frame) {
  constexpr std::int64_t unix_epoch = 116'444'736'000'000'000;
  return Stamp(mrpt::Clock::duration(unix_epoch + frame * 1'000'000LL));
}

TEST(KittiOdometryLayout, scans_images_and_poses_come_back) {
  const TestFolder folder;
  const SmallStreet street;
  const ToolResult result = import_sequence(write_sequence(folder.path(), street), folder);
  ASSERT_EQ(result.status, 0) << result.text;
  const ImportedLog log = read_imported(folder / "out.rawlog");
  ASSERT_EQ(log.scans.size(), kNumFrames);
  ASSERT_EQ(log.images.size(), kNumFrames);
  ASSERT_EQ(log.poses.size(), kNumFrames);
  // The vehicle's frame is the LiDAR's, the world's that of the first scan.
  const Pose T_vehicle_lidar = street.lidar.T_vehicle_lidar;
  Camera camera = street.camera.camera;
  camera.T_vehicle_camera = T_vehicle_lidar.inverse() * camera.T_vehicle_camera;
  const Pose T_world_first = street.T_world_vehicle(frame_stamp(0)) * T_vehicle_lidar;
  for (int i = 0; i < kNumFrames; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(log.scans[i].stamp, log_stamp(i));
    EXPECT_EQ(log.scans[i].label, "LIDAR");
    EXPECT_EQ(log.scans[i].points, kitti_points(street, frame_stamp(i)).points);
    expect_near(log.scans[i].T_vehicle_lidar, Pose::Identity(), 1e-9);
    EXPECT_EQ(log.images[i].stamp, log_stamp(i));
    expect_same_camera(log.images[i].camera, camera);
    const cv::Mat expected = street.picture(frame_stamp(i)).image.bgr;
    EXPECT_EQ(cv::norm(log.images[i].bgr, expected, cv::NORM_INF), 0);
    EXPECT_EQ(log.poses[i].stamp, log_stamp(i));
    EXPECT_EQ(log.pose_labels[i], "POSES");
    const Pose T_world_lidar = street.T_world_vehicle(frame_stamp(i)) * T_vehicle_lidar;
    expect_near(log.poses[i].T_world_vehicle, T_world_first.inverse() * T_world_lidar, 1e-5);
  }
}

TEST(KittiOdometryLayout, a_sequence_without_poses_is_a_log_without_poses) {
  const TestFolder folder;
  const fs::path sequence = write_sequence(folder.path(), SmallStreet());
  fs::remove(folder.path() / "poses/04.txt");
  ASSERT_EQ(import_sequence(sequence, folder).status, 0);
  const ImportedLog log = read_imported(folder / "out.rawlog");
  EXPECT_EQ(log.scans.size(), kNumFrames);
  EXPECT_EQ(log.poses.size(), 0U);
}

TEST(KittiOdometryLayout, missing_frames_are_reported_and_skipped) {
  const TestFolder folder;
  const fs::path sequence = write_sequence(folder.path(), SmallStreet());
  fs::remove(sequence / "velodyne/000001.bin");
  fs::remove(sequence / "image_2/000003.png");
  const ToolResult result = import_sequence(sequence, folder, "--first 1");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.text, "velodyne: 1 of 3 frames missing")) << result.text;
  EXPECT_TRUE(contains(result.text, "image_2: 1 of 3 frames missing")) << result.text;
  const ImportedLog log = read_imported(folder / "out.rawlog");
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].stamp, log_stamp(2));
  EXPECT_EQ(log.images.size(), 2U);
  EXPECT_EQ(log.poses.size(), 3U);
}

TEST(KittiOdometryLayout, what_is_wrong_is_named) {
  const TestFolder folder;
  const fs::path sequence = write_sequence(folder.path(), SmallStreet());
  const auto expect_failure = [&](const std::string& why) {
    const ToolResult result = import_sequence(sequence, folder);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.text, why)) << result.text;
  };
  std::ofstream(folder.path() / "poses/04.txt") << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0\n";
  expect_failure("04.txt, line 2");
  std::ofstream(sequence / "times.txt") << "0.0\nlater\n";
  expect_failure("times.txt, line 2: 'later'");
  std::ofstream(sequence / "calib.txt") << "P2: 1 2 3\n";
  expect_failure("calib.txt");
  const std::string out = " --output " + folder / "out.rawlog";
  EXPECT_EQ(run(KITTI2RAWLOG + out).status, 2);
  EXPECT_EQ(import_sequence(sequence, folder, "--drive " + sequence.string()).status, 2);
  EXPECT_EQ(import_sequence(sequence, folder, "--boxes " + folder / "b.csv").status, 2);
}

TEST(KittiOdometryLayout, a_pipe_in_place_of_a_file_is_named_and_not_waited_for) {
  const TestFolder folder;
  const fs::path sequence = write_sequence(folder.path(), SmallStreet());
  const auto import_with_pipe = [&](const fs::path& file) {
    const fs::path kept = folder.path() / "kept";
    fs::rename(file, kept);
    EXPECT_EQ(run("mkfifo " + file.string()).status, 0);
    const ToolResult result =
        run("timeout 60 " + std::string(KITTI2RAWLOG) + " --sequence " + sequence.string() +
            " --output " + folder / "out.rawlog" + " --overwrite");
    fs::rename(kept, file);
    return result;
  };
  for (const fs::path& file :
       {sequence / "times.txt", sequence / "calib.txt", folder.path() / "poses/04.txt"}) {
    const ToolResult result = import_with_pipe(file);
    EXPECT_EQ(result.status, 1) << file;
    EXPECT_TRUE(contains(result.text, file.string() + " is a pipe")) << result.text;
  }
  for (const fs::path& file : {sequence / "velodyne/000001.bin", sequence / "image_2/000001.png"}) {
    const ToolResult result = import_with_pipe(file);
    EXPECT_EQ(result.status, 0) << file;
    EXPECT_TRUE(contains(result.text, "1 of 4 frames missing")) << result.text;
  }
}

}  // namespace
}  // namespace lidar_upsampling
