// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>

#include "install/installed.h"

namespace lidar_upsampling {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// What bash offers for the last word. `compopt` works within a real completion only.
std::vector<std::string> completed(const std::string& tool, const std::string& words) {
  std::string function = "_" + tool;
  std::replace(function.begin(), function.end(), '-', '_');
  return words_of(text_of("bash -c 'compopt() { :; }; source " BUILD_FOLDER "/completions/" + tool +
                          "; COMP_WORDS=(" + tool + " " + words +
                          "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " + function +
                          "; echo \"${COMPREPLY[@]}\"'"));
}

using Words = std::vector<std::string>;

TEST(Completion, of_every_tool_knows_each_option_that_its_help_names) {
  for (const std::string& tool : tool_names()) {
    const Words offered = completed(tool, "--");
    const Words named = words_of(text_of(
        "(man --local-file " BUILD_FOLDER "/man/" + tool +
        ".1.gz | grep -oE '^ +(-[a-z], ?)?--[a-z0-9-]+' | sed 's/.*--/--/' | sort --unique)"));
    EXPECT_GE(named.size(), 4) << tool;
    for (const std::string& option : named)
      EXPECT_EQ(std::count(offered.begin(), offered.end(), option), 1) << tool << ' ' << option;
  }
}

TEST(Completion, an_option_is_completed_from_its_first_letters) {
  EXPECT_EQ(completed("rawlog-densify", "--ov"), Words{"--overwrite"});
}

TEST(Completion, a_file_name_is_left_to_the_shell) {
  EXPECT_EQ(completed("rawlog-densify", "--input \"\""), Words{});
}

TEST(Completion, settings_are_completed_by_their_names) {
  EXPECT_EQ(completed("rawlog-densify", "--set resamp"),
            (Words{"resample=", "resample.min_motion_m=", "resample.max_step_m=",
                   "resample.max_step_per_range=", "resample.max_bend_m=",
                   "resample.max_bend_per_range="}));
}

TEST(Completion, settings_are_completed_by_their_words_for_each_tool_that_takes_them) {
  for (const char* const tool : {"rawlog-densify", "rawlog-evaluate"}) {
    EXPECT_EQ(completed(tool, "--set resample \"=\""), (Words{"none", "beam"})) << tool;
    EXPECT_EQ(completed(tool, "--set resample \"=\" b"), Words{"beam"}) << tool;
    EXPECT_EQ(completed(tool, "--overwrite --set ego_motion.source \"=\" g"), Words{"gnss"})
        << tool;
    EXPECT_EQ(completed(tool, "--set timing.min_gap_ms \"=\""), Words{}) << tool;
  }
}

TEST(Completion, choices_are_completed_by_their_words) {
  EXPECT_EQ(completed("rawlog-export", "--format p"), Words{"ply"});
  EXPECT_EQ(completed("rawlog-evaluate", "--protocol kitti-o"), Words{"kitti-odometry"});
  EXPECT_EQ(completed("rawlog-simulate", "--scenario dem"), Words{"demo"});
}

TEST(Completion, is_loaded_by_the_tools_name) {
  for (const std::string& tool : tool_names())
    EXPECT_TRUE(contains(text_of("bash -c 'source " BUILD_FOLDER "/completions/" + tool +
                                 "; complete -p " + tool + "'"),
                         tool));
}

}  // namespace
}  // namespace lidar_upsampling
