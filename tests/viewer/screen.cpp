// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "screen.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "tools/run_tool.h"

namespace lidar_upsampling {
namespace {

// Fields of the header of an X window dump, big-endian words.
enum Field {
  header_size = 0,
  width = 4,
  height = 5,
  bits_per_pixel = 11,
  stride = 12,
  colors = 19
};

std::size_t field(const std::vector<std::uint8_t>& bytes, Field field) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = 256 * value + bytes.at(4 * static_cast<std::size_t>(field) + i);
  }
  return value;
}

cv::Mat read_window_dump(const std::string& path) {
  constexpr std::size_t kColorSize = 12;
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t pixel_size = field(bytes, bits_per_pixel) / 8;
  if (pixel_size < 3) throw std::runtime_error(path + " is no picture in true colour");
  cv::Mat picture(static_cast<int>(field(bytes, height)), static_cast<int>(field(bytes, width)),
                  CV_8UC3);
  const std::size_t start = field(bytes, header_size) + kColorSize * field(bytes, colors);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::size_t at = start + static_cast<std::size_t>(y) * field(bytes, stride) +
                             static_cast<std::size_t>(x) * pixel_size;
      picture.at<cv::Vec3b>(y, x) = {bytes.at(at), bytes.at(at + 1), bytes.at(at + 2)};
    }
  }
  return picture;
}

}  // namespace

Screen::Screen(std::string state, const std::string& program) : state_(std::move(state)) {
  act("start", program);
}

Screen::~Screen() { run("bash " SCREEN_SESSION " end " + state_); }

void Screen::act(const std::string& step, const std::string& arguments) const {
  const std::string command = "bash " SCREEN_SESSION " " + step + " " + state_ + " " + arguments;
  const ToolResult result = run(command);
  EXPECT_EQ(result.status, 0) << command << '\n' << result.text;
}

cv::Mat Screen::picture() const {
  const std::string file = state_ + "/picture.xwd";
  act("shot", file);
  return read_window_dump(file);
}

std::string Screen::missing(const std::string& program) {
  for (const std::string& needed :
       {program, std::string("Xvfb"), std::string("xdotool"), std::string("xwd")}) {
    if (run("command -v " + needed).status != 0) return needed + " is not installed";
  }
  return {};
}

}  // namespace lidar_upsampling
