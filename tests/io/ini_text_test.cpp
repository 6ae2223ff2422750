// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ini_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lidar_upsampling/nearest_word.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

std::string error_of(const std::string& content) {
  const TestFolder folder;
  std::ofstream(folder / "a.ini", std::ios::binary) << content;
  try {
    static_cast<void>(read_ini(folder / "a.ini"));
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    return text.substr(text.find("a.ini"));
  }
  return "none";
}

void expect_error(const std::string& content, const std::string& words) {
  EXPECT_NE(error_of(content).find(words), std::string::npos) << error_of(content);
}

TEST(IniText, comments_blank_lines_definitions_and_long_values_are_no_errors) {
  EXPECT_EQ(error_of("\xef\xbb\xbf# one\n\n; two\r\n@define W 15\n[a] ; three\nkey = 1 \\\n  2\n"
                     "[b]\nkey = \xc3\xa4\nother="),
            "none");
}

TEST(IniText, a_line_that_does_nothing_is_an_error_with_its_number) {
  expect_error("# settings\nmode = offline\n[a]\n", "a.ini:2: mode stands before any [section]");
  expect_error("[a]\nmode offline\n", "a.ini:2: 'mode offline': there is no '='");
  expect_error("[a]\n= 3\n", "a.ini:2: '= 3': there is no name");
  expect_error("[timing\nx = 1\n", "a.ini:1: '[timing': a bracket ]");
  expect_error("[ ]\nx = 1\n", "a.ini:1: '[ ]': there is no name");
  expect_error("[a] x = 1\n", "a.ini:1: 'x = 1' stands behind");
}

TEST(IniText, what_is_there_twice_is_an_error_with_both_lines) {
  expect_error("[a]\nx = 1\n\nX = 2\n", "a.ini:4: [a] X is there already, in line 2");
  expect_error("[a]\nx = 1\n[b]\n[a]\n", "a.ini:4: section [a] is there already, in line 1");
  EXPECT_EQ(error_of("[a]\nx = 1\n[b]\nx = 1\n"), "none");
}

TEST(IniText, what_is_no_text_is_told) {
  expect_error(std::string("\xff\xfe[\0a\0", 6), "UTF-16");
  expect_error(std::string("[\0a\0]\0", 6), "a.ini:1: this is no text");
  expect_error("[a]\nx = \x01\n", "a.ini:2: this is no text");
  expect_error(std::string(17U << 20U, '\n'), "a.ini: this is no settings file");
  const TestFolder folder;
  EXPECT_THROW(static_cast<void>(read_ini(folder.path().string())), std::runtime_error);
  EXPECT_THROW(static_cast<void>(read_ini(folder / "none.ini")), std::runtime_error);
}

TEST(IniText, an_error_of_a_key_gets_its_line) {
  const IniText ini{"a.ini", "", {{"[klt]", 1}, {"[klt] window_px", 3}}};
  EXPECT_EQ(ini.located("[klt] window_px = '1': odd"), "a.ini:3: [klt] window_px = '1': odd");
  EXPECT_EQ(ini.located("[klt] none: no such"), "a.ini:1: [klt] none: no such");
  EXPECT_EQ(ini.located("[other] key: no such"), "[other] key: no such");
  EXPECT_EQ(ini.located("something else"), "something else");
}

TEST(NearestWord, is_the_one_with_the_fewest_letters_changed) {
  const std::vector<std::string> known{"--input", "--output", "--overwrite"};
  EXPECT_EQ(did_you_mean("--inptu", known), "; did you mean --input?");
  EXPECT_EQ(did_you_mean("--ouput", known), "; did you mean --output?");
  EXPECT_EQ(did_you_mean("--over-write", known), "; did you mean --overwrite?");
}

TEST(NearestWord, is_none_where_all_are_far) {
  EXPECT_EQ(did_you_mean("resample", {"mode", "carrier"}), "");
  EXPECT_EQ(did_you_mean("mode", {}), "");
}

}  // namespace
}  // namespace lidar_upsampling
