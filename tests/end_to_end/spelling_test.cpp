// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <set>

#include "pages.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

namespace fs = std::filesystem;
using Words = std::set<std::string>;

// Names of the field and of programs, which no dictionary has: a word a line.
Words words_of_ours() {
  std::ifstream file(PROJECT_FOLDER "/tests/end_to_end/words.txt");
  Words words;
  for (std::string word; std::getline(file, word);) words.insert(word);
  return words;
}

// Without what is no English: code, addresses, options, paths, names in capitals or with digits.
std::string english_of(std::string text) {
  static const std::regex code(R"(`[^`]*`|\]\([^)]*\)|<[^>\n]*>)"),
      names(R"([^\s]*([_=/\\<>@]|::|\.\w)[^\s]*|-[\w-]+|'s\b)"),
      capitals(R"(\b[A-Z0-9]+\b|\b\w*\d\w*\b)");
  for (const std::regex* none : {&code, &names, &capitals})
    text = std::regex_replace(text, *none, " ");
  return text;
}

// Pages, comments of settings, and what the tools say of themselves, by where it stands.
std::vector<std::pair<std::string, std::string>> texts() {
  std::vector<std::pair<std::string, std::string>> found;
  for (const fs::path& page : pages())
    found.emplace_back(page, english_of(fenced(text_of_page(page)).prose));
  for (const auto& entry : fs::recursive_directory_iterator(CONFIG_FOLDER)) {
    std::string comments;
    if (entry.path().extension() == ".ini")
      for (const std::string& comment : matches(text_of_page(entry.path()), "[;#] ?([^\n]*)"))
        comments += comment + "\n";
    found.emplace_back(entry.path(), english_of(comments));
  }
  for (const auto& tool : fs::directory_iterator(BUILD_FOLDER "/bin"))
    found.emplace_back(tool.path(), english_of(run(tool.path().string() + " --help").text));
  return found;
}

Words unknown_words(const std::string& text) {
  const TestFolder folder;
  std::ofstream(folder / "text") << text;
  std::istringstream listed(run("hunspell -d en_GB -i UTF-8 -l " + folder / "text").text);
  const Words ours = words_of_ours();
  Words unknown;
  for (std::string word; std::getline(listed, word);)
    if (ours.count(word) == 0) unknown.insert(word);
  return unknown;
}

bool has_dictionary() { return run("echo word | hunspell -d en_GB -l").status == 0; }

TEST(Spelling, of_pages_settings_and_help_is_right) {
  if (!has_dictionary()) GTEST_SKIP() << "hunspell or hunspell-en-gb is not installed";
  const auto all = texts();
  std::string together;
  for (const auto& [place, text] : all) together += text;
  for (const std::string& word : unknown_words(together))
    for (const auto& [place, text] : all)
      if (contains(text, word))
        ADD_FAILURE() << place << ": " << word << " (if it is right: tests/end_to_end/words.txt)";
}

TEST(Spelling, a_misspelt_word_is_told) {
  if (!has_dictionary()) GTEST_SKIP() << "hunspell or hunspell-en-gb is not installed";
  EXPECT_EQ(unknown_words(english_of("A scann of the LiDAR's, see [there](thier.md), `thier` and "
                                     "config/thier.ini, colour and color")),
            (Words{"scann", "color"}));
}

TEST(Spelling, every_word_of_ours_is_used_and_in_its_place) {
  std::string all;
  for (const auto& [place, text] : texts()) all += text;
  const std::vector<std::string> used_words = matches(all, R"((\w+))");
  const Words used(used_words.begin(), used_words.end());
  std::ifstream file(PROJECT_FOLDER "/tests/end_to_end/words.txt");
  std::string before;
  for (std::string word; std::getline(file, word); before = word) {
    EXPECT_EQ(used.count(word), 1U) << word;
    EXPECT_LT(before, word);
  }
}

}  // namespace
}  // namespace lidar_upsampling
