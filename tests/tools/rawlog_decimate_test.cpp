// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/test_folder.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "run_tool.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

using Observation = mrpt::obs::CObservation::Ptr;

Stamp at(int i) { return Stamp(mrpt::Clock::duration(132000000000000000LL + 1'000'000LL * i)); }

Observation scan(int i) {
  LidarScan points;
  points.label = "LIDAR";
  points.stamp = at(i);
  for (int k = 0; k < 200; ++k) {
    points.points.emplace_back(static_cast<float>(k), static_cast<float>(i), 0.5F);
  }
  return observation_from_scan(points, Carrier::automatic);
}

Observation image(int i) {
  CameraImage picture;
  picture.stamp = at(i);
  picture.camera.label = "CAM";
  picture.bgr = cv::Mat(32, 48, CV_8UC3, cv::Scalar(i, 2 * i, 3 * i));
  return observation_from_image(picture);
}

std::string decimate(const std::string& arguments) {
  return std::string(RAWLOG_DECIMATE) + " " + arguments;
}

// 7 scans and 7 images, in turn.
void write_observations(const std::string& path) {
  RawlogWriter writer(path, false);
  for (int i = 0; i < 7; ++i) {
    writer.write(*scan(i));
    writer.write(*image(i));
  }
  writer.commit();
}

std::vector<Stamp> stamps_of(const std::vector<RawlogEntry>& entries, const std::string& label) {
  std::vector<Stamp> stamps;
  for (const RawlogEntry& entry : entries) {
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object);
    if (observation && observation->sensorLabel == label) stamps.push_back(observation->timestamp);
  }
  return stamps;
}

TEST(RawlogDecimate, keeps_none_of_a_sensor_where_every_0th_is_asked_for) {
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  const ToolResult result = run(decimate("--input " + folder / "in.rawlog" + " --output " +
                                         folder / "out.rawlog" + " --label LIDAR --keep-every 0"));
  ASSERT_EQ(result.status, 0) << result.text;
  const auto out = read_log(folder / "out.rawlog");
  EXPECT_EQ(out.size(), 7U);
  EXPECT_EQ(stamps_of(out, "CAM").size(), 7U);
}

TEST(RawlogDecimate, keeps_every_kth_and_all_else_byte_for_byte) {
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  const ToolResult result = run(decimate("--input " + folder / "in.rawlog" + " --output " +
                                         folder / "out.rawlog" + " --label LIDAR --keep-every 3"));
  ASSERT_EQ(result.status, 0) << result.text;
  const auto in = read_log(folder / "in.rawlog");
  const auto out = read_log(folder / "out.rawlog");
  EXPECT_EQ(stamps_of(out, "LIDAR"), (std::vector<Stamp>{at(0), at(3), at(6)}));
  EXPECT_EQ(stamps_of(out, "CAM").size(), 7U);
  std::size_t next = 0;  // the output is a subsequence of the input
  for (const RawlogEntry& entry : out) {
    while (next < in.size() && in[next].bytes != entry.bytes) ++next;
    ASSERT_LT(next, in.size());
    ++next;
  }
}

TEST(RawlogDecimate, offset_says_which_is_the_first) {
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  const ToolResult result =
      run(decimate("--input " + folder / "in.rawlog" + " --output " + folder / "out.rawlog" +
                   " --label LIDAR --keep-every 3 --offset 2"));
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_EQ(stamps_of(read_log(folder / "out.rawlog"), "LIDAR"),
            (std::vector<Stamp>{at(2), at(5)}));
}

TEST(RawlogDecimate, stock_rawlog_edit_counts_what_is_left) {
  if (!has_rawlog_edit()) GTEST_SKIP() << "rawlog-edit is not installed";
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  ASSERT_EQ(run(decimate("--input " + folder / "in.rawlog" + " --output " + folder / "out.rawlog" +
                         " --label LIDAR --keep-every 2"))
                .status,
            0);
  const ToolResult info = run("rawlog-edit --info -i " + folder / "out.rawlog");
  EXPECT_EQ(info.status, 0);
  EXPECT_TRUE(contains(info.text, "Overall number of objects         : 11")) << info.text;
  EXPECT_TRUE(contains(info.text, "LIDAR /      4 ")) << info.text;
}

TEST(RawlogDecimate, thins_inside_the_frames_of_an_action_log) {
  const TestFolder folder;
  {
    RawlogWriter writer(folder / "in.rawlog", false);
    for (int i = 0; i < 4; ++i) {
      mrpt::obs::CSensoryFrame frame;
      frame.insert(scan(i));
      frame.insert(image(i));
      writer.write(mrpt::obs::CActionCollection());
      writer.write(frame);
    }
    writer.commit();
  }
  ASSERT_EQ(run(decimate("--input " + folder / "in.rawlog" + " --output " + folder / "out.rawlog" +
                         " --label LIDAR --keep-every 2"))
                .status,
            0);
  const auto in = read_log(folder / "in.rawlog");
  const auto out = read_log(folder / "out.rawlog");
  ASSERT_EQ(out.size(), 8U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(out[2 * i].bytes, in[2 * i].bytes);
    if (i % 2 == 0) {
      EXPECT_EQ(out[2 * i + 1].bytes, in[2 * i + 1].bytes);
      continue;
    }
    const auto left = split_frame(out[2 * i + 1]);
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].bytes, split_frame(in[2 * i + 1])[1].bytes);
  }
}

TEST(RawlogDecimate, external_files_stay_reachable) {
  const TestFolder folder;
  fs::create_directory(folder / "in_Images");
  cv::imwrite(folder / "in_Images/0.png", cv::Mat(32, 48, CV_8UC1, cv::Scalar(77)));
  {
    RawlogWriter writer(folder / "in.rawlog", false);
    const auto picture = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(image(0));
    picture->image.setExternalStorage("0.png");
    writer.write(*picture);
    writer.write(*scan(0));
    writer.commit();
  }
  ASSERT_EQ(run(decimate("--input " + folder / "in.rawlog" + " --output " + folder / "out.rawlog" +
                         " --label LIDAR --keep-every 2"))
                .status,
            0);
  fs::rename(folder / "in.rawlog", folder / "gone.rawlog");
  RawlogReader reader(folder / "out.rawlog");
  const RawlogEntry entry = reader.next().value();
  auto& picture = dynamic_cast<mrpt::obs::CObservationImage&>(*entry.object);
  EXPECT_EQ(image_from_observation(picture).gray.at<std::uint8_t>(3, 3), 77);
}

TEST(RawlogDecimate, an_unknown_label_is_answered_with_those_there_are) {
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  const ToolResult result = run(decimate("--input " + folder / "in.rawlog" + " --output " +
                                         folder / "out.rawlog" + " --label VELO --keep-every 2"));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, "'CAM', 'LIDAR'")) << result.text;
  EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
  EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
}

TEST(RawlogDecimate, a_cut_log_fails_and_leaves_no_output) {
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  fs::resize_file(folder / "in.rawlog", fs::file_size(folder / "in.rawlog") * 3 / 4);
  const ToolResult result = run(decimate("--input " + folder / "in.rawlog" + " --output " +
                                         folder / "out.rawlog" + " --label LIDAR --keep-every 2"));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, "cut off")) << result.text;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(RawlogDecimate, an_existing_output_is_replaced_only_if_told) {
  const TestFolder folder;
  write_observations(folder / "in.rawlog");
  write_observations(folder / "out.rawlog");
  const std::string command = decimate("--input " + folder / "in.rawlog" + " --output " +
                                       folder / "out.rawlog" + " --label LIDAR --keep-every 2");
  const ToolResult refused = run(command);
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(contains(refused.text, "pass --overwrite")) << refused.text;
  EXPECT_EQ(read_log(folder / "out.rawlog").size(), 14U);
  EXPECT_EQ(run(command + " --overwrite").status, 0);
  EXPECT_EQ(read_log(folder / "out.rawlog").size(), 11U);
}

TEST(RawlogDecimate, wrong_usage_and_version_have_their_status) {
  EXPECT_EQ(run(decimate("")).status, 2);
  EXPECT_EQ(run(decimate("--input a --output b --label c --keep-every -1")).status, 2);
  EXPECT_EQ(run(decimate("--input a --output b --label c --keep-every 2 --what")).status, 2);
  EXPECT_EQ(run(decimate("--input /nowhere/a --output b --label c --keep-every 2")).status, 1);
  EXPECT_EQ(run(decimate("--help")).status, 0);
  const ToolResult version = run(decimate("--version"));
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.text.rfind("rawlog-decimate ", 0), 0U) << version.text;
}

}  // namespace
}  // namespace lidar_upsampling
