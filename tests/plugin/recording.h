// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/pipeline.h"

namespace lidar_upsampling {

/// Plays in.rawlog of a folder through the stock rawlog-grabber.
class RawlogGrabber : public testing::Test {
 protected:
  void SetUp() override {
    if (run("command -v rawlog-grabber").status != 0)
      GTEST_SKIP() << "rawlog-grabber is not installed";
  }

  /// The shipped settings with changes, run in the folder; rawlog-grabber's words.
  [[nodiscard]] std::string grab(const std::string& edits) const {
    expect_done("sed " + edits + " " CONFIG_FOLDER "/rawlog-grabber-play.ini >" +
                folder_ / "play.ini");
    // A key press ends it, which the end of its input counts for: so give it one that stays silent.
    const ToolResult result = run("cd " + folder_.path().string() +
                                  " && mkfifo silence && ( timeout 100 rawlog-grabber -p " PLUGIN
                                  " play.ini <>silence )");
    EXPECT_EQ(result.status, 0) << result.text;
    return result.text;
  }

  [[nodiscard]] std::string recording() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.path().filename().string().rfind("upsampled_", 0) == 0 &&
          entry.path().extension() == ".rawlog")
        return entry.path().string();
    return {};
  }

  TestFolder folder_;
};

inline void expect_same(const std::vector<Logged>& found, const std::vector<Logged>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(found[i].bytes, expected[i].bytes) << i << ": " << found[i].label();
}

inline void expect_in_time_order(const std::vector<Logged>& all) {
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_LE(all[i - 1].stamp(), all[i].stamp()) << i << ": " << all[i].label();
}

}  // namespace lidar_upsampling
