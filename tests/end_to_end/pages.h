// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace lidar_upsampling {

inline std::vector<std::filesystem::path> pages() {
  const std::filesystem::path project = PROJECT_FOLDER;
  std::vector<std::filesystem::path> found{project / "README.md", project / "CONTRIBUTING.md",
                                           project / "CHANGELOG.md"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(project / "share"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

inline std::string text_of_page(const std::filesystem::path& page) {
  std::ifstream file(page);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What the pattern's first group holds, match by match.
inline std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}
inline std::vector<std::string> matches(const std::string& text, const char* pattern) {
  return matches(text, std::regex(pattern));
}

/// A page without its blocks, and those.
struct Fenced {
  std::string prose;
  std::vector<std::string> blocks;  ///< those without a language
};

inline Fenced fenced(const std::string& text) {
  Fenced parts;
  std::istringstream lines(text);
  bool within = false, is_plain = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) {
      within = !within;
      if (within) is_plain = line == "```";
      if (within && is_plain) parts.blocks.emplace_back();
    } else if (!within) {
      parts.prose += line + "\n";
    } else if (is_plain) {
      parts.blocks.back() += line + "\n";
    }
  }
  return parts;
}

}  // namespace lidar_upsampling
