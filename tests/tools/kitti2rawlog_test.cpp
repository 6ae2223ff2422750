// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/test_folder.h"
#include "kitti_day.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/log_index.h"
#include "run_tool.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

constexpr int kNumFrames = 4;

std::string numbered(int number, const std::string& extension) {
  char name[16];
  std::snprintf(name, sizeof name, "%010d", number);
  return name + extension;
}

void write_stamps(const fs::path& folder, int milliseconds) {
  fs::create_directories(folder / "data");
  std::ofstream out(folder / "timestamps.txt");
  for (int i = 0; i < kNumFrames; ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "2011-09-26 13:00:0%d.%03d000049\n", i, milliseconds);
    out << line;
  }
}

cv::Mat picture(int number) {
  cv::Mat pixels(20, 60, CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(number) + 1);
  random.fill(pixels, cv::RNG::UNIFORM, 0, 256);
  return pixels;
}

// Four frames of scan, camera 2 and OXTS, camera 2 being 10 ms after the scan, OXTS 10 ms before.
fs::path write_drive(const TestFolder& folder) {
  const fs::path day = folder.path() / "day";
  write_kitti_calibration(day);
  fs::path drive = day / "drive";
  write_stamps(drive / "velodyne_points", 100);
  write_stamps(drive / "image_02", 110);
  write_stamps(drive / "oxts", 90);
  for (int i = 0; i < kNumFrames; ++i) {
    const float step = static_cast<float>(i);
    const std::vector<float> points = {5, 1,    0.5F, 0.25F, 5, 2, 0.5F, 0.5F,
                                       6, step, -1,   1,     0, 0, 0,    0};
    std::ofstream(drive / "velodyne_points/data" / numbered(i, ".bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(points.data()),
               static_cast<std::streamsize>(points.size() * sizeof(float)));
    cv::imwrite((drive / "image_02/data" / numbered(i, ".png")).string(), picture(i));
    std::ofstream(drive / "oxts/data" / numbered(i, ".txt")) << "49 8 100 0 0 0." << i << " 1 1\n";
  }
  return drive;
}

std::string command(const std::string& drive, const std::string& output, const std::string& more) {
  return std::string(KITTI2RAWLOG) + " --drive " + drive + " --output " + output + " " + more;
}

ToolResult convert(const std::string& drive, const std::string& output,
                   const std::string& more = "") {
  return run(command(drive, output, more));
}

TEST(Kitti2Rawlog, a_drive_becomes_a_log_in_the_order_of_time) {
  const TestFolder folder;
  const ToolResult result = convert(write_drive(folder).string(), folder / "out.rawlog");
  ASSERT_EQ(result.status, 0) << result.text;
  const auto entries = read_log(folder / "out.rawlog");
  ASSERT_EQ(entries.size(), 12U);
  const std::vector<std::string> labels = {"OXTS", "LIDAR", "CAM2"};
  Stamp last;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entries[i].object);
    EXPECT_EQ(observation->sensorLabel, labels[i % 3]);
    EXPECT_GT(observation->timestamp, last);
    last = observation->timestamp;
  }
}

TEST(Kitti2Rawlog, points_and_pixels_arrive_without_loss) {
  const TestFolder folder;
  ASSERT_EQ(convert(write_drive(folder).string(), folder / "out.rawlog").status, 0);
  const auto entries = read_log(folder / "out.rawlog");
  auto& scan_observation = dynamic_cast<mrpt::obs::CObservation&>(*entries[7].object);
  const LidarScan scan = scan_from_observation(scan_observation).value();
  ASSERT_EQ(scan.size(), 3U);  // without the one in the origin
  EXPECT_EQ(scan.points[2], Eigen::Vector3f(6, 2, -1));
  EXPECT_NEAR(scan.intensity[1], 0.5F, 0.002F);
  EXPECT_TRUE(scan.T_vehicle_lidar.translation().isApprox(Eigen::Vector3d(0.8, -0.3, 0.8), 1e-9));
  auto& image_observation = dynamic_cast<mrpt::obs::CObservationImage&>(*entries[8].object);
  const CameraImage image = image_from_observation(image_observation);
  EXPECT_EQ(cv::norm(image.bgr, picture(2), cv::NORM_INF), 0);
  EXPECT_EQ(image.camera.model.fx, 57);
}

TEST(Kitti2Rawlog, oxts_becomes_poses) {
  const TestFolder folder;
  ASSERT_EQ(convert(write_drive(folder).string(), folder / "out.rawlog").status, 0);
  const LogIndex index = index_log(folder / "out.rawlog");
  ASSERT_EQ(index.poses.size(), 4U);
  const Eigen::Vector3d ahead = index.poses[3].T_world_vehicle.linear() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0.3, 1e-9);
}

TEST(Kitti2Rawlog, first_and_last_choose_frames) {
  const TestFolder folder;
  const std::string drive = write_drive(folder).string();
  ASSERT_EQ(convert(drive, folder / "out.rawlog", "--first 1 --last 2").status, 0);
  EXPECT_EQ(read_log(folder / "out.rawlog").size(), 6U);
  EXPECT_EQ(convert(drive, folder / "none.rawlog", "--first 9").status, 1);
  EXPECT_FALSE(fs::exists(folder / "none.rawlog"));
}

TEST(Kitti2Rawlog, missing_frames_are_reported_and_skipped) {
  const TestFolder folder;
  const fs::path drive = write_drive(folder);
  fs::remove(drive / "image_02/data" / numbered(2, ".png"));
  const ToolResult result = convert(drive.string(), folder / "out.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.text, "image_02: 1 of 4 frames missing")) << result.text;
  EXPECT_EQ(read_log(folder / "out.rawlog").size(), 11U);
}

TEST(Kitti2Rawlog, broken_input_is_one_line_and_no_output) {
  const TestFolder folder;
  const fs::path drive = write_drive(folder);
  const auto expect_failure = [&](const std::string& culprit, const std::string& more = "") {
    const ToolResult result = run_for_errors(command(drive.string(), folder / "out.rawlog", more));
    EXPECT_EQ(result.status, 1) << culprit;
    EXPECT_TRUE(contains(result.text, culprit)) << result.text;
    EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
    EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
  };
  expect_failure("image_03/timestamps.txt", "--cameras 2,3");
  std::ofstream(drive / "image_02/data" / numbered(3, ".png")) << "no picture";
  expect_failure(numbered(3, ".png"));
  fs::resize_file(drive / "velodyne_points/data" / numbered(1, ".bin"), 30);
  expect_failure(numbered(1, ".bin"));
  std::ofstream(drive / "velodyne_points/timestamps.txt") << "yesterday\n";
  expect_failure("yesterday");
  fs::remove(folder.path() / "day/calib_velo_to_cam.txt");
  expect_failure("calib_velo_to_cam.txt");
}

std::size_t num_of(const std::string& log, const std::string& label, StreamKind kind) {
  const LogIndex index = index_log(log);
  const StreamInfo* const stream = index.find(label, kind);
  return stream == nullptr ? 0 : stream->count;
}

TEST(Kitti2Rawlog, real_drive_0052_has_31_scans_and_31_images) {
  const fs::path drive = data_folder() / "kitti_raw/2011_09_26/2011_09_26_drive_0052_sync";
  if (!fs::exists(drive)) GTEST_SKIP() << "no " << drive;
  const TestFolder folder;
  const ToolResult result = convert(drive.string(), folder / "out.rawlog");
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_EQ(num_of(folder / "out.rawlog", "LIDAR", StreamKind::lidar), 31U);
  EXPECT_EQ(num_of(folder / "out.rawlog", "CAM2", StreamKind::camera), 31U);
  if (!has_rawlog_edit()) return;
  const ToolResult info = run("rawlog-edit --info -i " + folder / "out.rawlog");
  EXPECT_TRUE(contains(info.text, "CAM2 /     31 ")) << info.text;
  EXPECT_TRUE(contains(info.text, "LIDAR /     31 ")) << info.text;
}

TEST(Kitti2Rawlog, real_drive_0005_has_40_frames_and_reports_the_rest) {
  const fs::path drive = data_folder() / "kitti_raw/2011_09_26/2011_09_26_drive_0005_sync";
  if (!fs::exists(drive)) GTEST_SKIP() << "no " << drive;
  const TestFolder folder;
  const ToolResult result = convert(drive.string(), folder / "out.rawlog", "--cameras 2");
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(contains(result.text, "velodyne_points: 114 of 154 frames missing")) << result.text;
  EXPECT_EQ(read_log(folder / "out.rawlog").size(), 120U);
  EXPECT_EQ(num_of(folder / "out.rawlog", "OXTS", StreamKind::pose), 40U);
}

TEST(Kitti2Rawlog, a_broken_picture_is_told_in_our_line_alone) {
  const TestFolder folder;
  const fs::path drive = write_drive(folder),
                 broken = drive / "image_02/data" / numbered(3, ".png");
  std::fstream file(broken, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(fs::file_size(broken) / 2));
  file << std::string(100, 'x');
  file.close();
  const ToolResult result = run_for_errors(command(drive, folder / "a.rawlog", ""));
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.text,
            "kitti2rawlog: " + broken.string() + " holds no picture, or a broken one\n");
  EXPECT_FALSE(fs::exists(folder / "a.rawlog"));
}

}  // namespace
}  // namespace lidar_upsampling
