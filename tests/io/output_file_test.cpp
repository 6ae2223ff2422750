// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/text_file.h"
#include "small_logs.h"
#include "test_folder.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void touch(const std::string& path) { std::ofstream(path) << "old"; }

/// Without a temporary name, and with one, as file systems need that know no others.
class Output : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] static OutputOptions options(bool overwrite) {
    return {overwrite, false, GetParam()};
  }
  TestFolder folder_;
};

TEST_P(Output, appears_when_it_is_complete_and_nothing_beside_it) {
  OutputFile file(folder_ / "a", options(false));
  file.write("one ");
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  file.write("two");
  file.commit();
  EXPECT_EQ(content_of(folder_ / "a"), "one two");
  EXPECT_EQ(num_files(folder_.path()), 1U);
}

TEST_P(Output, that_is_not_committed_leaves_nothing) {
  { OutputFile(folder_ / "a", options(false)).write("half"); }
  EXPECT_EQ(num_files(folder_.path()), 0U);
}

TEST_P(Output, replaces_a_file_at_once_if_told) {
  touch(folder_ / "a");
  EXPECT_THROW(OutputFile(folder_ / "a", options(false)), std::runtime_error);
  OutputFile file(folder_ / "a", options(true));
  file.write("new");
  EXPECT_EQ(content_of(folder_ / "a"), "old");
  file.commit();
  EXPECT_EQ(content_of(folder_ / "a"), "new");
  EXPECT_EQ(num_files(folder_.path()), 1U);
}

TEST_P(Output, does_not_replace_a_file_that_came_up_in_the_meantime) {
  {
    OutputFile file(folder_ / "a", options(false));
    touch(folder_ / "a");
    EXPECT_THROW(file.commit(), std::runtime_error);
  }
  EXPECT_EQ(content_of(folder_ / "a"), "old");
  EXPECT_EQ(num_files(folder_.path()), 1U);
}

TEST_P(Output, may_be_read_by_whom_the_umask_lets) {
  const mode_t before = umask(027);
  OutputFile file(folder_ / "a", options(false));
  file.commit();
  umask(before);
  EXPECT_EQ(fs::status(folder_ / "a").permissions(), fs::perms(0640));
}

TEST_P(Output, goes_where_a_link_leads_be_that_there_or_not) {
  fs::create_symlink("a", folder_ / "link");
  for (const std::string text : {"first", "second"}) {
    OutputFile file(folder_ / "link", options(true));
    file.write(text);
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(content_of(folder_ / "a"), text);
  }
}

TEST_P(Output, removes_what_killed_runs_have_left_of_it_and_no_more) {
  for (const char* name : {"a.tmp-20240101", "a.tmp-0123456789ab", "b.tmp-0123456789ab",
                           "a.tmp-mine", "a.tmp-", "a.part"})
    touch(folder_ / name);
  fs::create_directory(folder_ / "a.tmp-0123456789ac");
  OutputFile file(folder_ / "a", options(false));
  file.commit();
  EXPECT_FALSE(fs::exists(folder_ / "a.tmp-0123456789ab"));
  EXPECT_EQ(num_files(folder_.path()), 7U);
}

TEST_P(Output, two_of_one_process_may_not_go_to_one_place) {
  fs::create_directory(folder_ / "sub");
  OutputFile file(folder_ / "a", options(true));
  EXPECT_THROW(OutputFile(folder_ / "sub/../a", options(true)), std::runtime_error);
  file.commit();
  EXPECT_NO_THROW(OutputFile(folder_ / "a", options(true)));
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithName, Output, ::testing::Bool());

TEST(ScratchFile, never_has_a_name_and_gives_back_what_was_written) {
  const TestFolder folder;
  OutputFile scratch = OutputFile::scratch(folder / "a");
  scratch.write("one two");
  EXPECT_EQ(num_files(folder.path()), 0U);
  std::string three(3, ' ');
  EXPECT_EQ(scratch.read(4, three.data(), 3), 3U);
  EXPECT_EQ(three, "two");
  OutputFile file(folder / "a");
  file.write("zero ");
  file.append(scratch);
  file.commit();
  EXPECT_EQ(content_of(folder / "a"), "zero one two");
}

TEST(TextFile, tells_on_commit_that_not_all_was_written) {
  TextFile file("/dev/full", {true, true});
  for (int i = 0; i < 100000; ++i) file.stream() << "text ";
  EXPECT_THROW(file.commit(), std::runtime_error);
}

TEST(CheckFiles, an_output_that_is_an_input_is_found_out_by_whatever_name) {
  const TestFolder folder;
  touch(folder / "in");
  fs::create_hard_link(folder / "in", folder / "hard");
  fs::create_symlink("in", folder / "soft");
  for (const char* name : {"in", "hard", "soft"})
    EXPECT_THROW(check_files({{"--input", folder / "in"}}, {{"--report", folder / name}}),
                 std::runtime_error);
  EXPECT_NO_THROW(check_files({{"--input", folder / "in"}, {"--config", ""}},
                              {{"--report", folder / "out"}, {"--output", ""}}));
}

TEST(CheckFiles, outputs_of_one_place_and_places_that_are_none_are_refused) {
  const TestFolder folder;
  fs::create_symlink("a", folder / "soft");
  EXPECT_THROW(check_files({}, {{"--output", folder / "a"}, {"--report", folder / "soft"}}),
               std::runtime_error);
  EXPECT_THROW(check_files({}, {{"--report", folder / "no/a"}}), std::runtime_error);
  EXPECT_THROW(check_files({}, {{"--report", folder.path().string()}}), std::runtime_error);
  EXPECT_NO_THROW(check_files({}, {{"--report", "/dev/stdout"}}));
}

TEST(CheckRoom, a_log_that_takes_more_than_is_free_is_refused_and_others_are_not) {
  const TestFolder folder;
  std::ofstream(folder / "plain") << "a log";
  std::ofstream(folder / "packed") << "\x1f\x8b";
  for (const char* name : {"plain", "packed"})
    EXPECT_NO_THROW(check_room({"--output", folder / "out"}, folder / name, true));
  constexpr std::uintmax_t kTooLarge = 1ULL << 43U;
  std::error_code too_large_for_the_file_system;
  for (const char* name : {"plain", "packed"})
    std::filesystem::resize_file(folder / name, kTooLarge, too_large_for_the_file_system);
  if (too_large_for_the_file_system || std::filesystem::space(folder.path()).available >= kTooLarge)
    GTEST_SKIP() << "no file of 8 TB can be made here, or there is room for it";
  EXPECT_THROW(check_room({"--output", folder / "out"}, folder / "plain", true),
               std::runtime_error);
  EXPECT_THROW(check_room({"--output", folder / "out"}, folder / "packed", false),
               std::runtime_error);
  EXPECT_NO_THROW(check_room({"--output", folder / "out"}, folder / "packed", false, 1e-12));
  EXPECT_NO_THROW(check_room({"--output", folder / "out"}, folder / "plain", false));
  EXPECT_NO_THROW(check_room({"--output", "/dev/null"}, folder / "plain", true));
}

TEST(CheckRoom, is_told_of_an_output_of_any_kind) {
  const TestFolder folder;
  EXPECT_NO_THROW(check_room({"--output", folder / "out"}, 1000));
  EXPECT_NO_THROW(check_room({"--output", ""}, 1e18));
  try {
    check_room({"--output", folder / "out"}, 1e18);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("MB are free there, and it takes more than"),
              std::string::npos)
        << error.what();
  }
}

TEST(FileNames, labels_with_slashes_become_names_that_are_told_apart) {
  FileNames names;
  EXPECT_EQ(names.of("CAM0"), "CAM0");
  EXPECT_EQ(names.of("/cam/left"), "_cam_left");
  EXPECT_EQ(names.of("_cam/left"), "_cam_left-2");
  EXPECT_EQ(names.of("/cam/left"), "_cam_left");
}

}  // namespace
}  // namespace lidar_upsampling
