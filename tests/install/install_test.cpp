// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "install/installed.h"
#include "io/test_folder.h"

namespace lidar_upsampling {
namespace {

class Install : public ::testing::Test {
 protected:
  void SetUp() override {
    text_of("cmake --install " BUILD_FOLDER " --prefix " + prefix_.path().string());
  }
  [[nodiscard]] bool has(const std::string& file) const {
    return std::filesystem::is_regular_file(prefix_.path() / file);
  }
  [[nodiscard]] std::string path(const std::string& file) const { return prefix_ / file; }

 private:
  TestFolder prefix_;
};

TEST_F(Install, every_tool_runs_from_the_prefix) {
  ASSERT_GE(tool_names().size(), 6);
  for (const std::string& tool : tool_names())
    EXPECT_TRUE(contains(text_of(path("bin/" + tool) + " --version"), tool + " 0.")) << tool;
}

TEST_F(Install, files_lie_where_debian_expects_them) {
  for (const char* file :
       {"include/lidar_upsampling/upsampler.h", "include/lidar_upsampling/io/carriers.h",
        INSTALLED_LIBDIR "/liblidar_upsampling.a",
        INSTALLED_LIBDIR "/cmake/lidar_upsampling/lidar_upsampling-config.cmake",
        INSTALLED_LIBDIR "/cmake/lidar_upsampling/lidar_upsampling-config-version.cmake",
        INSTALLED_LIBDIR "/mrpt-plugins/mrpt_lidar_upsampling.so",
        "share/lidar_upsampling/config/default.ini",
        "share/lidar_upsampling/config/scenarios/small.ini"})
    EXPECT_TRUE(has(file)) << file;
  for (const std::string& tool : tool_names())
    EXPECT_TRUE(has("share/bash-completion/completions/" + tool)) << tool;
}

TEST_F(Install, a_scenario_that_comes_along_is_found_by_its_name) {
  const TestFolder folder;
  text_of("cd " + folder.path().string() + " && " + path("bin/rawlog-simulate") +
          " --scenario small --duration 0.2 --output in.rawlog");
  EXPECT_TRUE(std::filesystem::exists(folder / "in.rawlog"));
}

TEST_F(Install, a_film_is_made_by_a_library_that_nobody_else_waits_for) {
  const TestFolder folder;
  text_of("cd " + folder.path().string() + " && " + path("bin/rawlog-simulate") +
          " --scenario small --duration 0.3 --output in.rawlog && " + path("bin/rawlog-densify") +
          " --input in.rawlog --output out.rawlog --film film.avi");
  EXPECT_TRUE(std::filesystem::exists(folder / "film.avi"));
  EXPECT_FALSE(contains(text_of("ldd " + path("bin/rawlog-densify")), "videoio"));
}

TEST_F(Install, every_tool_has_a_man_page_that_lists_its_options) {
  for (const std::string& tool : tool_names()) {
    const std::string page =
        text_of("man --local-file " + path("share/man/man1/" + tool + ".1.gz"));
    for (const char* part : {"NAME", "SYNOPSIS", "OPTIONS", "--version", "EXAMPLES", "EXIT STATUS",
                             "FILES", "SEE ALSO"})
      EXPECT_TRUE(contains(page, part)) << tool << " lacks " << part << '\n' << page;
  }
}

TEST_F(Install, the_cmake_package_names_no_folder_of_the_build) {
  const std::string package = path(INSTALLED_LIBDIR "/cmake/lidar_upsampling");
  ASSERT_NE(run("grep -r lidar_upsampling " + package).text, "");
  EXPECT_EQ(run("grep -rF -e " BUILD_FOLDER " -e " SOURCE_FOLDER " " + package).text, "");
}

TEST_F(Install, a_program_of_someone_else_finds_the_package_builds_and_runs) {
  const TestFolder build;
  text_of("cmake -S " CONSUMER_FOLDER " -B " + build.path().string() +
          " -D CMAKE_PREFIX_PATH=" + path("") + " -D CMAKE_BUILD_TYPE=Debug");
  text_of("cmake --build " + build.path().string());
  EXPECT_EQ(text_of(build / "consumer"), "scans without images: no virtual scan\n");
}

}  // namespace
}  // namespace lidar_upsampling
