// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/ply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/test_folder.h"
#include "tools/run_tool.h"

namespace lidar_upsampling::argoverse {
namespace {

PlyVertices parse(const std::string& content) {
  const TestFolder folder;
  std::ofstream(folder / "a.ply", std::ios::binary) << content;
  return read_ply(folder / "a.ply");
}

const std::string kHeader =
    "element vertex 2\nproperty short a\ncomment by hand\nproperty double b\nelement face 1\n"
    "property list uchar int vertex_index\nend_header\n";

TEST(Ply, text_and_binary_hold_the_same_numbers) {
  using namespace std::string_literals;
  const PlyVertices text =
      parse("ply\nformat ascii 1.0\n" + kHeader + "-2 0.5\n300 nan\n3 0 1 2\n");
  const PlyVertices binary = parse("ply\r\nformat binary_little_endian 1.0\r\n" + kHeader +
                                   "\xFE\xFF\0\0\0\0\0\0\xE0\x3F\x2C\x01\0\0\0\0\0\0\xF8\x7F"s);
  for (const PlyVertices& vertices : {text, binary}) {
    EXPECT_EQ(vertices.property("a"), (std::vector<double>{-2, 300}));
    EXPECT_EQ(vertices.property("b")[0], 0.5);
    EXPECT_TRUE(std::isnan(vertices.property("b")[1]));
  }
}

TEST(Ply, other_files_are_refused_with_their_name_and_reason) {
  const auto expect_refused = [](const std::string& content, const std::string& why) {
    try {
      static_cast<void>(parse(content));
      FAIL() << why;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(contains(error.what(), "a.ply")) << error.what();
      EXPECT_TRUE(contains(error.what(), why)) << error.what();
    }
  };
  expect_refused("solid", "no PLY");
  expect_refused("ply\nformat ascii 1.0\n", "within its header");
  expect_refused("ply\nformat binary_big_endian 1.0\n" + kHeader, "binary_big_endian");
  expect_refused("ply\nformat ascii 1.0\nelement face 1\n", "element face 1");
  expect_refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int i\n", "list");
  expect_refused("ply\nformat ascii 1.0\n" + kHeader + "1 2 3\n", "vertex 1");
  expect_refused("ply\nformat binary_little_endian 1.0\n" + kHeader + "1234", "2 vertices");
  try {
    static_cast<void>(parse("ply\nformat ascii 1.0\n" + kHeader + "1 2 3 4\n").property("x"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(contains(error.what(), "'x'")) << error.what();
  }
}

}  // namespace
}  // namespace lidar_upsampling::argoverse
