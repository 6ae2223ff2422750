// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace lidar_upsampling {

/// A program with windows on a virtual screen of its own; share/screen-session.sh does the work.
class Screen {
 public:
  /// @param state a folder that does not exist yet.
  Screen(std::string state, const std::string& program);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// A step of screen-session.sh, such as "row 7"; the test fails if it shows no effect.
  void act(const std::string& step, const std::string& arguments) const;
  [[nodiscard]] cv::Mat picture() const;  ///< CV_8UC3

  /// What is missing on this machine, empty if nothing.
  [[nodiscard]] static std::string missing(const std::string& program);

 private:
  std::string state_;
};

}  // namespace lidar_upsampling
