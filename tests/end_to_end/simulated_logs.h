// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "tools/run_tool.h"

namespace lidar_upsampling {

/// What goes wrong in a tool that was expected to work.
inline void expect_done(const std::string& command) {
  const ToolResult result = run(command);
  EXPECT_EQ(result.status, 0) << command << '\n' << result.text;
}

/// Logs that today's simulator has made, kept in the build folder: many tests, each a process of
/// its own, want the same one, and most of their time was to make it.
inline std::filesystem::path simulated_logs() {
  namespace fs = std::filesystem;
  const fs::path all = SIMULATED_LOGS;
  const auto built = fs::last_write_time(RAWLOG_SIMULATE).time_since_epoch().count();
  const fs::path own = all / std::to_string(built);
  fs::create_directories(all);
  if (fs::create_directory(own))
    for (const auto& other : fs::directory_iterator(all))
      if (other.path() != own) fs::remove_all(other);
  return own;
}

/// Makes in.rawlog, in_*.csv and truth.rawlog of a scenario's text in a folder.
inline void simulate_in(const std::filesystem::path& folder, const std::string& scenario) {
  namespace fs = std::filesystem;
  const fs::path kept = simulated_logs() / std::to_string(std::hash<std::string>{}(scenario));
  if (!fs::exists(kept)) {
    const fs::path made = kept.string() + "_" + std::to_string(getpid());
    fs::create_directory(made);
    std::ofstream(made / "street.ini") << scenario;
    expect_done(std::string(RAWLOG_SIMULATE) + " --scenario " + (made / "street.ini").string() +
                " --output " + (made / "in.rawlog").string() + " --truth " +
                (made / "truth.rawlog").string());
    std::error_code another_was_first;
    if (!testing::Test::HasFailure()) fs::rename(made, kept, another_was_first);
    fs::copy(fs::exists(made) ? made : kept, folder, fs::copy_options::recursive);
    fs::remove_all(made);
    return;
  }
  fs::copy(kept, folder, fs::copy_options::recursive);
}

}  // namespace lidar_upsampling
