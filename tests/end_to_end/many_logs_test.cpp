// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// Three logs of different lengths, and a folder for what becomes of them.
void write_three(const TestFolder& folder) {
  fs::create_directory(folder / "dense");
  for (const int tens : {1, 2, 3}) {
    HandMadeLog log;
    log.num_images = log.num_instants = 10 * tens;
    write_hand_made(folder / ("log" + std::to_string(tens) + ".rawlog"), log);
  }
}

std::string three_of(const TestFolder& folder) {
  return folder / "log1.rawlog" + " " + folder / "log2.rawlog" + " " + folder / "log3.rawlog";
}

TEST(ManyLogs, each_becomes_what_it_becomes_by_itself) {
  const TestFolder folder;
  write_three(folder);
  for (const std::string jobs : {"1", "2"}) {
    expect_done(densify_command(three_of(folder), folder / "dense",
                                "--overwrite --jobs " + jobs + " --report " + folder / "reports" +
                                    " --pictures " + folder / "pictures"));
    for (const std::string log : {"log1", "log2", "log3"}) {
      expect_done(
          densify_command(folder / (log + ".rawlog"), folder / "alone.rawlog", "--overwrite"));
      EXPECT_TRUE(file_bytes(folder / ("dense/" + log + ".rawlog")) ==
                  file_bytes(folder / "alone.rawlog"))
          << log;
      EXPECT_TRUE(fs::exists(folder / ("reports/" + log + ".json")));
      EXPECT_FALSE(fs::is_empty(folder / ("pictures/" + log)));
    }
  }
}

TEST(ManyLogs, one_that_is_damaged_is_named_at_the_end_and_the_others_are_done) {
  const TestFolder folder;
  write_three(folder);
  fs::resize_file(folder / "log2.rawlog", fs::file_size(folder / "log2.rawlog") / 2);
  const ToolResult result =
      run_for_errors(densify_command(three_of(folder), folder / "dense", "--jobs 2"));
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(count_of(result.text, "\n"), 1) << result.text;
  EXPECT_TRUE(contains(result.text, "1 of 3 logs")) << result.text;
  EXPECT_TRUE(contains(result.text, "log2.rawlog: broken after")) << result.text;
  EXPECT_EQ(num_files(fs::path(folder / "dense")), 2U);
  EXPECT_EQ(with_label(observations_of(folder / "dense/log3.rawlog"), "LIDAR_VIRTUAL").size(), 20U);
}

TEST(ManyLogs, outputs_that_would_be_one_or_the_input_are_refused_before_any_work) {
  const TestFolder folder;
  write_three(folder);
  fs::create_directory(folder / "more");
  fs::copy_file(folder / "log1.rawlog", folder / "more/log1.rawlog");
  const auto expect_refused = [&](const std::string& inputs, const std::string& output,
                                  const std::string& words) {
    const ToolResult result = run_for_errors(densify_command(inputs, output, "--overwrite"));
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.text, words)) << result.text;
    EXPECT_TRUE(fs::is_empty(folder / "dense"));
  };
  expect_refused(three_of(folder), folder / "no", "a folder");
  expect_refused(three_of(folder), folder.path().string(), "would be itself");
  expect_refused(folder / "log1.rawlog" + " " + folder / "more/log1.rawlog", folder / "dense",
                 "would be one");
}

}  // namespace
}  // namespace lidar_upsampling
