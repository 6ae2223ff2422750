// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/mrpt_errors.h"

#include <algorithm>
#include <string_view>

namespace lidar_upsampling {

std::string one_line(const std::exception& error) {
  std::string_view text = error.what();
  // MRPT's layout is "==== MRPT exception ====\nMessage: ...\nMsg prefix: ...\nLocation: ...".
  constexpr std::string_view kMark = "Message:";
  const auto at = text.find(kMark);
  if (text.find("MRPT exception") < at && at != std::string_view::npos) {
    text.remove_prefix(at + kMark.size());
  }
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \t\n")));
  text = text.substr(0, text.find('\n'));
  return std::string(text);
}

}  // namespace lidar_upsampling
