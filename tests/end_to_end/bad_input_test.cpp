// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

std::string command(const TestFolder& folder, const std::string& more = "") {
  return densify_command(folder / "in.rawlog", folder / "out.rawlog", more);
}

// One line on stderr with these words, exit status 1, and nothing new in the folder.
void expect_refused(const TestFolder& folder, const std::string& command_line,
                    const std::vector<std::string>& words) {
  const std::size_t num_before = num_files(folder.path());
  const ToolResult result = run_for_errors(command_line);
  EXPECT_EQ(result.status, 1) << result.text;
  EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), 1) << result.text;
  for (const std::string& word : words)
    EXPECT_TRUE(contains(result.text, word)) << word << " is not in: " << result.text;
  EXPECT_EQ(num_files(folder.path()), num_before);
}

void expect_refused(const TestFolder& folder, const std::vector<std::string>& words,
                    const std::string& more = "") {
  expect_refused(folder, command(folder, more), words);
  EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
}

TEST(BadInput, the_log_that_the_others_are_worse_than_is_densified) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_done(command(folder));
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 6U);
}

TEST(BadInput, a_missing_input_is_named) {
  const TestFolder folder;
  expect_refused(folder, {"in.rawlog"});
}

TEST(BadInput, a_folder_is_no_input) {
  const TestFolder folder;
  fs::create_directory(folder / "in.rawlog");
  expect_refused(folder, {"in.rawlog"});
}

TEST(BadInput, a_file_that_is_no_rawlog_is_told_apart) {
  const TestFolder folder;
  std::ofstream(folder / "in.rawlog") << "Dear diary, today I saw two red lorries.\n";
  expect_refused(folder, {"in.rawlog", "rawlog"});
  std::ofstream(folder / "in.rawlog", std::ios::trunc).flush();
  expect_refused(folder, {"in.rawlog"});
}

TEST(BadInput, a_log_that_is_cut_off_is_refused_wherever_the_cut_is) {
  const TestFolder folder;
  write_hand_made(folder / "whole.rawlog");
  const Bytes packed = file_bytes(folder / "whole.rawlog");
  const Bytes plain = uncompressed(folder / "whole.rawlog");
  for (const Bytes& whole : {packed, plain}) {
    for (const std::size_t size :
         {whole.size() / 100, whole.size() / 3, whole.size() * 3 / 4, whole.size() - 1}) {
      write_bytes(folder / "in.rawlog", {whole.begin(), whole.begin() + static_cast<long>(size)});
      expect_refused(folder, {"in.rawlog"});
    }
  }
}

TEST(BadInput, what_is_readable_of_a_cut_log_is_densified_if_told_with_a_warning) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  fs::resize_file(folder / "in.rawlog", fs::file_size(folder / "in.rawlog") * 3 / 4);
  const ToolResult result = run(command(folder, "--accept-truncated"));
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.text, "warning")) << result.text;
  const auto scans = with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL");
  EXPECT_GE(scans.size(), 2U);
  EXPECT_LT(scans.size(), 6U);
}

TEST(BadInput, an_unknown_lidar_label_is_answered_with_the_labels_there_are) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_refused(folder, {"NOPE", "LIDAR", "CAM"}, "--set lidar_label=NOPE");
}

TEST(BadInput, an_unknown_camera_label_is_answered_with_the_labels_there_are) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_refused(folder, {"NOPE", "LIDAR", "CAM"}, "--set camera_labels=NOPE");
}

TEST(BadInput, a_log_without_images_is_refused) {
  const TestFolder folder;
  HandMadeLog log;
  log.num_images = 0;
  write_hand_made(folder / "in.rawlog", log);
  expect_refused(folder, {"no images", "LIDAR"});
}

TEST(BadInput, images_without_calibration_are_refused_until_the_settings_give_it) {
  const TestFolder folder;
  HandMadeLog log;
  log.calibrated = false;
  write_hand_made(folder / "in.rawlog", log);
  expect_refused(folder, {"CAM", "no calibration"});
  expect_done(command(folder,
                      "--set camera.CAM.fx_px=90 --set camera.CAM.fy_px=90"
                      " --set camera.CAM.cx_px=80 --set camera.CAM.cy_px=40"));
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 6U);
}

TEST(BadInput, clocks_that_do_not_overlap_are_refused) {
  for (const double hour : {-3600., 3600.}) {
    const TestFolder folder;
    HandMadeLog log;
    log.image_delay_s = hour;
    write_hand_made(folder / "in.rawlog", log);
    expect_refused(folder, {"clocks do not overlap", "LIDAR", "CAM"});
  }
}

TEST(BadInput, one_wrong_stamp_is_no_reason_to_refuse_a_log) {
  for (const double hour : {-3600., 3600.}) {
    const TestFolder folder;
    HandMadeLog log;
    log.first_scan_delay_s = hour;
    write_hand_made(folder / "in.rawlog", log);
    const ToolResult result = run(command(folder));
    EXPECT_EQ(result.status, 0) << result.text;
    EXPECT_NE(result.text.find("the clock jumps"), std::string::npos) << result.text;
  }
}

TEST(BadInput, a_scan_and_an_image_of_one_label_and_stamp_are_two) {
  const TestFolder folder;
  HandMadeLog log;
  log.lidar_label = "CAM";
  write_hand_made(folder / "in.rawlog", log);
  const ToolResult result = run(command(folder));
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_EQ(result.text.find("twice"), std::string::npos) << result.text;
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "CAM_VIRTUAL").size(), 6U);
}

TEST(BadInput, settings_that_cannot_be_read_are_named) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_refused(folder, {"output_label", "LIDAR", "sensor"}, "--set output_label=LIDAR");
  expect_refused(folder, {"output_label", "CAM", "sensor"}, "--set output_label=CAM");
  expect_refused(folder, {"no_such_key"}, "--set no_such_key=1");
  expect_refused(folder, {"klt", "no_such_key"}, "--set klt.no_such_key=1");
  expect_refused(folder, {"window_px", "large"}, "--set klt.window_px=large");
  expect_refused(folder, {"carrier", "pigeon"}, "--set carrier=pigeon");
  expect_refused(folder, {"name=value"}, "--set carrier");
  expect_refused(folder, {"kl"}, "--set kl.window_px=15");
  const std::string command_line = std::string(RAWLOG_DENSIFY) + " --input " +
                                   folder / "in.rawlog" + " --output " + folder / "out.rawlog" +
                                   " --config ";
  expect_refused(folder, command_line + folder / "none.ini", {"none.ini"});
}

TEST(BadInput, an_unknown_key_of_a_settings_file_is_named) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  std::ofstream(folder / "bad.ini") << "[klt]\nwindows_px = 15\n";
  expect_refused(folder,
                 std::string(RAWLOG_DENSIFY) + " --input " + folder / "in.rawlog" + " --output " +
                     folder / "out.rawlog" + " --config " + folder / "bad.ini",
                 {"klt", "windows_px"});
}

TEST(BadInput, an_existing_output_is_replaced_only_if_told) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  std::ofstream(folder / "out.rawlog") << "mine";
  expect_refused(folder, command(folder), {"out.rawlog", "--overwrite"});
  EXPECT_EQ(fs::file_size(folder / "out.rawlog"), 4U);
  expect_done(command(folder, "--overwrite"));
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 6U);
}

TEST(BadInput, the_input_itself_is_no_output) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  const Bytes before = file_bytes(folder / "in.rawlog");
  expect_refused(folder, densify_command(folder / "in.rawlog", folder / "in.rawlog"),
                 {"in.rawlog"});
  EXPECT_TRUE(file_bytes(folder / "in.rawlog") == before);
}

TEST(BadInput, an_output_folder_that_is_not_there_is_named) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_refused(folder, densify_command(folder / "in.rawlog", folder / "no/such/out.rawlog"),
                 {"no/such"});
}

TEST(BadInput, a_full_disk_leaves_no_output) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  // No file may grow beyond 32 blocks; the signal that tells so is ignored, writing then fails.
  expect_refused(folder, "trap '' XFSZ; ulimit -f 32; " + command(folder), {"out.rawlog"});
  EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
}

TEST(BadInput, external_images_that_are_missing_or_broken_are_counted_and_the_rest_goes_on) {
  const TestFolder folder;
  HandMadeLog log;
  log.external_image = 4;
  log.external_file = "lost.png";
  write_hand_made(folder / "in.rawlog", log);
  const ToolResult missing = run(command(folder));
  EXPECT_EQ(missing.status, 0);
  EXPECT_TRUE(contains(missing.text, "warning (1x)")) << missing.text;
  EXPECT_TRUE(contains(missing.text, "lost.png")) << missing.text;
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 5U);

  fs::create_directory(folder / "in_Images");
  std::ofstream(folder / "in_Images/lost.png") << "no picture";
  const ToolResult broken = run(command(folder, "--overwrite"));
  EXPECT_EQ(broken.status, 0);
  EXPECT_TRUE(contains(broken.text, "warning (1x)")) << broken.text;
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 5U);
}

TEST(BadInput, wrong_usage_has_a_status_of_its_own) {
  EXPECT_EQ(run(RAWLOG_DENSIFY).status, 2);
  EXPECT_EQ(run(std::string(RAWLOG_DENSIFY) + " --input a.rawlog").status, 2);
  EXPECT_EQ(run(std::string(RAWLOG_DENSIFY) + " --input a --output b --what").status, 2);
  EXPECT_EQ(run(std::string(RAWLOG_DENSIFY) + " --input a --output b --warm-up nan").status, 2);
  EXPECT_EQ(run(RAWLOG_EVALUATE).status, 2);
  EXPECT_EQ(run(std::string(RAWLOG_EVALUATE) + " --reference a --input b --max-range nan").status,
            2);
  EXPECT_EQ(run(RAWLOG_SIMULATE).status, 2);
  EXPECT_EQ(run(KITTI2RAWLOG).status, 2);
}

TEST(Tools, all_tell_their_version_and_how_they_are_used) {
  for (const std::string tool :
       {KITTI2RAWLOG, RAWLOG_DECIMATE, RAWLOG_DENSIFY, RAWLOG_EVALUATE, RAWLOG_SIMULATE}) {
    const ToolResult version = run(tool + " --version");
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.text, fs::path(tool).filename().string() + " 0.1.0\n");
    EXPECT_EQ(run(tool + " --help").status, 0);
  }
}

}  // namespace
}  // namespace lidar_upsampling
