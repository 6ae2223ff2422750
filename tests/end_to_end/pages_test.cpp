// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "pipeline.h"

namespace lidar_upsampling {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  const fs::path project = PROJECT_FOLDER;
  std::vector<fs::path> found{project / "README.md", project / "CONTRIBUTING.md",
                              project / "CHANGELOG.md"};
  for (const auto& entry : fs::recursive_directory_iterator(project / "share"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

std::string text_of_page(const fs::path& page) {
  std::ifstream file(page);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

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

TEST(Pages, every_option_of_densifying_in_an_example_is_one) {
  const std::string help = run(std::string(RAWLOG_DENSIFY) + " --help").text;
  for (const fs::path& page : pages())
    for (const std::string& line :
         matches(text_of_page(page), R"(rawlog-densify((?: +[-\w./=$<>]+)+))"))
      for (const std::string& option : matches(line, R"((--[a-z-]+))"))
        EXPECT_NE(help.find(option), std::string::npos) << page << ": " << line;
}

TEST(Pages, README_tells_it_in_a_hundred_lines) {
  const std::string text = text_of_page(pages().front());
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 100);
}

}  // namespace
}  // namespace lidar_upsampling
