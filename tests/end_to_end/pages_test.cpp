// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>
#include <map>

#include "pages.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

namespace fs = std::filesystem;

TEST(Pages, every_link_to_a_file_leads_to_one) {
  for (const fs::path& page : pages())
    for (const std::string& link : matches(text_of_page(page), R"(\]\(([^)#\s]+))")) {
      if (link.find("://") != std::string::npos) continue;
      EXPECT_TRUE(fs::exists(page.parent_path() / link)) << page << " links to " << link;
    }
}

TEST(Pages, every_program_of_the_build_folder_is_there) {
  for (const fs::path& page : pages())
    for (const std::string& tool :
         matches(text_of_page(page), R"((?:build/release/bin|\$bin)/([a-z0-9-]+))"))
      EXPECT_TRUE(fs::exists(fs::path(BUILD_FOLDER) / "bin" / tool)) << page << " runs " << tool;
}

struct Example {
  std::string tool, words;
};

// In blocks and within sentences; commands that go on in the next line are joined.
std::vector<Example> examples_of(const fs::path& page) {
  static const std::regex joint(R"(\\\n *)"),
      command(R"(((?:rawlog|kitti2rawlog|argoverse2rawlog|dgp2rawlog)[a-z-]*))"
              R"(((?: +[-\w./=<>{},$]+)*))");
  const std::string text = std::regex_replace(text_of_page(page), joint, " ");
  std::vector<Example> found;
  for (std::sregex_iterator match(text.begin(), text.end(), command), end; match != end; ++match)
    if (fs::exists(fs::path(BUILD_FOLDER) / "bin" / (*match)[1].str()))
      found.push_back({(*match)[1], (*match)[2]});
  return found;
}

// What a tool prints when it is given one option.
const std::string& said_by(const std::string& tool, const std::string& option) {
  static std::map<std::string, std::string> known;
  std::string& text = known[tool + option];
  if (text.empty()) text = run(std::string(BUILD_FOLDER) + "/bin/" + tool + " " + option).text;
  return text;
}

TEST(Pages, every_option_of_a_tool_in_an_example_is_one) {
  int num_options = 0;
  for (const fs::path& page : pages())
    for (const Example& example : examples_of(page))
      for (const std::string& option : matches(example.words, R"( (--?[a-z][a-z-]*))")) {
        const std::regex listed("[ ,]" + option + "[ ,\n]");
        EXPECT_TRUE(std::regex_search(said_by(example.tool, "--help"), listed))
            << page << ": " << example.tool << example.words << ": " << option;
        ++num_options;
      }
  EXPECT_GE(num_options, 40);
}

TEST(Pages, every_setting_in_an_example_is_one) {
  int num_settings = 0;
  for (const fs::path& page : pages())
    for (const std::string& name :
         matches(text_of_page(page), R"(--set (?:\w+\.)?(?!name)([a-z_0-9]+) ?=)")) {
      EXPECT_TRUE(contains(said_by("rawlog-densify", "--print-config"), "\n" + name + " ="))
          << page << ": " << name;
      ++num_settings;
    }
  EXPECT_GE(num_settings, 3);
}

TEST(Pages, every_file_of_config_that_is_named_is_there) {
  for (const fs::path& page : pages())
    for (const std::string& file : matches(text_of_page(page), R"((config/[\w/-]+\.\w+))"))
      EXPECT_TRUE(fs::exists(fs::path(PROJECT_FOLDER) / file)) << page << " names " << file;
}

TEST(Pages, no_word_stands_twice_in_a_row) {
  const std::regex twice(R"([\s(]([A-Za-z]{2,})\s+\1[\s.,;:)])");
  for (const fs::path& page : pages()) {
    const std::string text = text_of_page(page);
    std::smatch match;
    EXPECT_FALSE(std::regex_search(text, match, twice)) << page << ": " << match[0];
  }
}

TEST(Pages, README_tells_it_in_a_hundred_lines) {
  const std::string text = text_of_page(pages().front());
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 100);
}

}  // namespace
}  // namespace lidar_upsampling
