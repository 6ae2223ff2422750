// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tools/run_tool.h"

namespace lidar_upsampling {

/// Every command-line tool of the build.
inline std::vector<std::string> tool_names() {
  std::istringstream words(TOOL_NAMES);
  std::vector<std::string> names;
  for (std::string name; words >> name;) names.push_back(name);
  return names;
}

/// @return stdout and stderr of a command that is expected to work.
inline std::string text_of(const std::string& command) {
  const ToolResult result = run(command);
  EXPECT_EQ(result.status, 0) << command << '\n' << result.text;
  return result.text;
}

}  // namespace lidar_upsampling
