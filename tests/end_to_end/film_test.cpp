// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>
#include <opencv2/videoio.hpp>

#include "pipeline.h"

namespace lidar_upsampling {
namespace {

TEST(Film, has_a_frame_per_scan_at_a_third_of_their_rate) {
  const TestFolder folder;
  simulate(folder);
  std::filesystem::create_directory(folder / "films");  // not the log's, which is tidied up before
  densify(folder, "--film " + folder / "films/film.avi");
  cv::VideoCapture film(folder / "films/film.avi");
  ASSERT_TRUE(film.isOpened());
  cv::Mat frame;
  int frames = 0;
  while (film.read(frame)) ++frames;
  constexpr int kKeyScans = 4;  // those that virtual ones are made of
  EXPECT_EQ(frames, kVirtualScans + kKeyScans);
  EXPECT_NEAR(film.get(cv::CAP_PROP_FPS), 10, 0.5);
}

TEST(Film, one_of_nothing_is_told_and_leaves_no_file) {
  const TestFolder folder;
  simulate(folder, "[camera.CAM0]\nrate_hz = 10\n");
  const ToolResult result = run(densify_command(folder / "in.rawlog", folder / "out.rawlog",
                                                "--film " + folder / "film.avi"));
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_NE(result.text.find("no film is made"), std::string::npos) << result.text;
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(file.path().string().find("film"), std::string::npos) << file.path();
}

TEST(Film, another_ending_is_refused_before_the_work) {
  const TestFolder folder;
  simulate(folder);
  const ToolResult result = run(densify_command(folder / "in.rawlog", folder / "out.rawlog",
                                                "--film " + folder / "film.txt"));
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.text.find(".mp4, .avi or .mkv"), std::string::npos) << result.text;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.rawlog"));
}

}  // namespace
}  // namespace lidar_upsampling
