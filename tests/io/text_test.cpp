// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace lidar_upsampling {
namespace {

TEST(OneLine, that_quotes_a_file_without_line_ends_has_its_begin_and_its_end) {
  const std::runtime_error error("a.ini:1: '" + std::string(3000000, 'x') + "' does nothing");
  const std::string line = one_line(error);
  EXPECT_LT(line.size(), 2100U);
  EXPECT_EQ(line.rfind("a.ini:1: 'xxx", 0), 0U);
  EXPECT_NE(line.find("xx ... xx"), std::string::npos);
  EXPECT_EQ(line.substr(line.size() - 15), "x' does nothing");
}

TEST(OneLine, that_is_not_long_stays) {
  EXPECT_EQ(one_line(std::runtime_error("what\nwhere")), "what");
  EXPECT_EQ(shortened(std::string(2000, 'x')), std::string(2000, 'x'));
}

TEST(OneLine, keeps_letters_whole_where_it_is_shortened) {
  std::string letters;
  for (int i = 0; i < 100; ++i) letters += "\xe2\x82\xac";
  for (const std::size_t most : {40U, 41U, 42U, 43U}) {
    const std::string line = shortened(letters, most);
    const auto gap = line.find(" ... ");
    ASSERT_NE(gap, std::string::npos);
    EXPECT_EQ(gap % 3, 0U);
    EXPECT_EQ((line.size() - gap - 5) % 3, 0U);
  }
}

}  // namespace
}  // namespace lidar_upsampling
