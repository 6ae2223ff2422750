// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>
#include <fstream>
#include <sstream>

#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// share/fleet on a folder of logs, of which those that are good are two streets of 5 scans.
class Fleet : public testing::Test {
 protected:
  void SetUp() override {
    if (run("command -v snakemake").status != 0) GTEST_SKIP() << "snakemake is not installed";
    simulate(folder_);
    fs::create_directories(logs_);
    for (const char* name : {"in.rawlog", "in_objects.csv", "in_ego.csv"})
      fs::copy(folder_ / name, logs_ / name);
  }

  /// @return the summary; empty where there is none.
  [[nodiscard]] std::string summary(int status, const std::string& tools = BUILD_FOLDER) const {
    std::ofstream(folder_ / "fleet.yaml")
        << "inputs: logs\noutput: out\ntools: " << tools << "\nevaluate: --no-paper --no-chamfer\n";
    const ToolResult result = run(
        "snakemake --snakefile " FLEET_FOLDER "/Snakefile --directory " + folder_.path().string() +
        " --configfile " + folder_ / "fleet.yaml" + " --jobs 2 --keep-going --rerun-incomplete");
    EXPECT_EQ(result.status, status) << result.text;
    std::ostringstream text;
    text << std::ifstream(folder_ / "out/summary.md").rdbuf();
    return text.str();
  }

  /// A folder of tools whose rawlog-densify is a script's lines.
  [[nodiscard]] std::string tools_with_densify(const std::string& script) const {
    const fs::path tools = folder_.path() / "tools";
    fs::create_directories(tools);
    fs::create_symlink(RAWLOG_DECIMATE, tools / "rawlog-decimate");
    fs::create_symlink(RAWLOG_EVALUATE, tools / "rawlog-evaluate");
    std::ofstream(tools / "rawlog-densify") << "#!/bin/sh\n" << script;
    fs::permissions(tools / "rawlog-densify", fs::perms::owner_all);
    return tools.string();
  }

  TestFolder folder_;
  fs::path logs_ = folder_.path() / "logs";
};

// 3 of the 5 scans are kept, and of 13 images those at their instants need none.
constexpr const char* kDone = ".html) | 3 | 10 | ";

TEST_F(Fleet, one_page_has_each_logs_figures_and_why_a_damaged_one_failed) {
  fs::copy(logs_ / "in.rawlog", logs_ / "unlabelled.rawlog");
  fs::copy(logs_ / "in.rawlog", logs_ / "cut.rawlog");
  fs::resize_file(logs_ / "cut.rawlog", fs::file_size(logs_ / "cut.rawlog") / 3);
  const std::string page = summary(0);
  EXPECT_TRUE(contains(page, "3 logs: 2 densified and evaluated, 1 failed")) << page;
  EXPECT_TRUE(contains(page, "\n| [in](in/errors" + std::string(kDone))) << page;
  EXPECT_TRUE(contains(page, "\n| [unlabelled](unlabelled/errors" + std::string(kDone))) << page;
  EXPECT_TRUE(contains(page, "\n| cut | thin: rawlog-decimate: ")) << page;
  EXPECT_TRUE(contains(page, "broken after")) << page;
}

TEST_F(Fleet, a_job_that_is_killed_is_done_again) {
  const std::string page =
      summary(0, tools_with_densify("mkdir " + folder_ / "killed" +
                                    " && kill -9 $$\nexec " RAWLOG_DENSIFY " \"$@\"\n"));
  EXPECT_TRUE(contains(page, "1 logs: 1 densified and evaluated, 0 failed")) << page;
  EXPECT_TRUE(contains(page, kDone)) << page;
}

TEST_F(Fleet, a_job_that_is_killed_each_time_is_told_in_the_summary) {
  const std::string page = summary(0, tools_with_densify("kill -9 $$\n"));
  EXPECT_TRUE(contains(page, "| in | densify: killed by SIGKILL, each time |")) << page;
}

TEST_F(Fleet, a_job_that_is_given_up_is_told_in_the_summary_and_done_when_asked_again) {
  const std::string tools = tools_with_densify("kill -9 $PPID\n");
  const std::string page = summary(1, tools);
  EXPECT_TRUE(contains(page, "| in | densify: not finished |")) << page;
  std::ofstream(tools + "/rawlog-densify") << "#!/bin/sh\nexec " RAWLOG_DENSIFY " \"$@\"\n";
  EXPECT_TRUE(contains(summary(0, tools), kDone));
}

}  // namespace
}  // namespace lidar_upsampling
