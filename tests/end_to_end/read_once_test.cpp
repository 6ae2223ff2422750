// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <functional>
#include <string>
#include <vector>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

/// Longer than what a run looks ahead: 4 s, 40 scans, 120 images.
HandMadeLog long_log() {
  HandMadeLog log;
  log.num_images = log.num_instants = 120;
  return log;
}

constexpr std::size_t kLongVirtualScans = 80;

const std::string& label_of(const RawlogEntry& entry) {
  return dynamic_cast<mrpt::obs::CObservation&>(*entry.object).sensorLabel;
}

/// in.rawlog: a long log, changed.
void write_changed(const TestFolder& folder,
                   const std::function<void(std::vector<RawlogEntry>&)>& change) {
  write_hand_made(folder / "long.rawlog", long_log());
  std::vector<RawlogEntry> entries = read_log(folder / "long.rawlog");
  change(entries);
  RawlogWriter writer(folder / "in.rawlog", false);
  for (const RawlogEntry& entry : entries) writer.write(entry);
  writer.commit();
}

nlohmann::json densified(const TestFolder& folder, const std::string& more = "") {
  densify(folder, "--report " + folder / "report.json" + " " + more);
  std::ifstream file(folder / "report.json");
  return nlohmann::json::parse(file, nullptr, false);
}

void expect_refused(const TestFolder& folder, const std::string& words) {
  const std::size_t num_before = num_files(folder.path());
  const ToolResult result =
      run_for_errors(densify_command(folder / "in.rawlog", folder / "out.rawlog"));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, words)) << result.text;
  EXPECT_EQ(num_files(folder.path()), num_before);
}

bool is_pose(const RawlogEntry& entry) { return label_of(entry) == "POSE"; }

void drop_poses(std::vector<RawlogEntry>& entries) {
  entries.erase(std::remove_if(entries.begin(), entries.end(), is_pose), entries.end());
}

// Of a pipe nothing can be read twice.
void expect_the_same_through_a_pipe(const TestFolder& folder, const std::string& more) {
  densify(folder, more);
  const std::string pipe = folder / "pipe.rawlog";
  expect_done("mkfifo " + pipe + " && { timeout 60 cat " + folder / "in.rawlog" + " > " + pipe +
              " & timeout 60 " + densify_command(pipe, folder / "once.rawlog", more) + "; }");
  EXPECT_TRUE(uncompressed(folder / "once.rawlog") == uncompressed(folder / "out.rawlog"));
  EXPECT_EQ(with_label(observations_of(folder / "once.rawlog"), "LIDAR_VIRTUAL").size(),
            kLongVirtualScans);
}

TEST(ReadOnce, a_log_that_comes_through_a_pipe_gives_what_the_file_gives) {
  for (const std::string more : {"", "--set mode=offline"}) {
    const TestFolder folder;
    write_hand_made(folder / "in.rawlog", long_log());
    expect_the_same_through_a_pipe(folder, more);
  }
}

TEST(ReadOnce, a_log_without_ego_motion_comes_through_a_pipe_too) {
  const TestFolder folder;
  write_changed(folder, drop_poses);
  expect_the_same_through_a_pipe(folder, "");
}

// Large pictures that nobody can use: no second and a half of them may wait. By the second run's
// setting all of the log is known first.
TEST(ReadOnce, a_log_too_heavy_to_be_held_gives_what_it_gives_when_all_of_it_is_known) {
  const TestFolder folder;
  HandMadeLog log;
  log.num_images = log.num_instants = 48;
  write_hand_made(folder / "light.rawlog", log);
  log.calibrated = false;
  CameraImage large = still_picture(log, 0);
  large.camera.label = "LARGE";
  large.bgr = cv::Mat::zeros(800, 1100, CV_8UC3);
  RawlogWriter writer(folder / "in.rawlog", false);
  for (const RawlogEntry& entry : read_log(folder / "light.rawlog")) {
    writer.write(entry);
    if (label_of(entry) != "CAM") continue;
    large.stamp = *stamp_of(entry);
    writer.write(*observation_from_image(large));
  }
  writer.commit();
  densify(folder);
  expect_done(densify_command(folder / "in.rawlog", folder / "known.rawlog",
                              "--set ego_motion.max_interpolation_gap_s=3"));
  EXPECT_TRUE(uncompressed(folder / "known.rawlog") == uncompressed(folder / "out.rawlog"));
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 32U);
}

TEST(ReadOnce, poses_that_only_come_at_the_end_of_a_log_are_used_from_the_start) {
  const TestFolder folder;
  write_changed(folder, [](std::vector<RawlogEntry>& entries) {
    std::stable_partition(entries.begin(), entries.end(),
                          [](const RawlogEntry& entry) { return !is_pose(entry); });
  });
  const auto report = densified(folder);
  EXPECT_EQ(report["ego_motion"], "poses");
  EXPECT_EQ(report["virtual_scans"], kLongVirtualScans);
  EXPECT_EQ(report["virtual_scans_with_extrapolated_ego_motion"], 0);
}

TEST(ReadOnce, images_that_come_up_late_are_used) {
  const TestFolder folder;
  write_changed(folder, [](std::vector<RawlogEntry>& entries) {
    int num_images = 0;
    const auto is_early = [&](const RawlogEntry& entry) {
      return label_of(entry) == "CAM" && ++num_images <= 90;
    };
    entries.erase(std::remove_if(entries.begin(), entries.end(), is_early), entries.end());
  });
  EXPECT_EQ(densified(folder)["virtual_scans"], kLongVirtualScans / 4);
}

TEST(ReadOnce, a_second_lidar_that_comes_up_late_is_to_be_chosen_from) {
  const TestFolder folder;
  write_changed(folder, [](std::vector<RawlogEntry>& entries) {
    LidarScan scan = wall_scan(119);
    scan.label = "OTHER";
    entries.push_back(entry_of(observation_from_scan(scan, Carrier::automatic)));
  });
  expect_refused(folder, "several streams of 3D scans");
  EXPECT_EQ(densified(folder, "--set lidar_label=LIDAR")["virtual_scans"], kLongVirtualScans);
}

TEST(ReadOnce, a_long_log_whose_end_is_missing_is_refused_and_leaves_nothing) {
  const TestFolder folder;
  write_changed(folder, [](std::vector<RawlogEntry>& entries) { entries.back().bytes.resize(9); });
  expect_refused(folder, "--accept-truncated");
  const auto report = densified(folder, "--accept-truncated");
  EXPECT_EQ(report["entries_in"], 279);
  EXPECT_EQ(report["warnings"].size(), 1U);
}

}  // namespace
}  // namespace lidar_upsampling
