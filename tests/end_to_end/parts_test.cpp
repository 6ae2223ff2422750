// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <map>
#include <set>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "lidar_upsampling/io/carriers.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

/// Long enough for three parts.
HandMadeLog three_parts_long() {
  HandMadeLog log;
  log.num_images = log.num_instants = 390;
  return log;
}

nlohmann::json report_at(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file, nullptr, false);
}

/// in.rawlog to one.rawlog and parts.rawlog, with reports.
void densify_both(const TestFolder& folder, int num_parts, const std::string& more = "") {
  expect_done(densify_command(folder / "in.rawlog", folder / "one.rawlog",
                              more + " --report " + folder / "one.json"));
  expect_done(densify_command(
      folder / "in.rawlog", folder / "parts.rawlog",
      more + " --report " + folder / "parts.json" + " --jobs " + std::to_string(num_parts)));
}

/// How far the points of two scans lie apart, m; infinite of different numbers of points.
double most_apart(const Logged& a, const Logged& b) {
  const auto scan_a = scan_from_observation(*a.observation);
  const auto scan_b = scan_from_observation(*b.observation);
  if (scan_a->size() != scan_b->size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t i = 0; i < scan_a->size(); ++i)
    most = std::max(most, static_cast<double>((scan_a->points[i] - scan_b->points[i]).norm()));
  return most;
}

void expect_one_log(const TestFolder& folder) {
  const auto in = observations_of(folder / "in.rawlog");
  const auto out = observations_of(folder / "parts.rawlog");
  const auto real = without_label(out, "LIDAR_VIRTUAL");
  ASSERT_EQ(real.size(), in.size());
  for (std::size_t i = 0; i < in.size(); ++i) EXPECT_TRUE(real[i].bytes == in[i].bytes) << i;
  EXPECT_EQ(stamps_of(out), stamps_of(observations_of(folder / "one.rawlog")));
}

TEST(Parts, all_real_observations_and_virtual_scans_are_there_once_and_in_order) {
  for (const std::string more : {"", "--set mode=offline"}) {
    const TestFolder folder;
    write_hand_made(folder / "in.rawlog", three_parts_long());
    densify_both(folder, 3, more);
    expect_one_log(folder);
    const auto one = with_label(observations_of(folder / "one.rawlog"), "LIDAR_VIRTUAL");
    const auto parts = with_label(observations_of(folder / "parts.rawlog"), "LIDAR_VIRTUAL");
    ASSERT_EQ(one.size(), parts.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_LT(most_apart(one[i], parts[i]), 1e-3) << i;
    const auto whole = report_at(folder / "one.json"), joined = report_at(folder / "parts.json");
    for (const char* key : {"entries_in", "scans_in", "images_in", "virtual_scans", "ego_motion",
                            "carrier", "resampling", "warnings", "mode"})
      EXPECT_EQ(whole[key], joined[key]) << key;
  }
}

TEST(Parts, as_many_always_give_the_same_bytes) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog", three_parts_long());
  for (const std::string out : {"first.rawlog", "second.rawlog"})
    expect_done(densify_command(folder / "in.rawlog", folder / out, "--jobs 3"));
  EXPECT_TRUE(file_bytes(folder / "first.rawlog") == file_bytes(folder / "second.rawlog"));
}

TEST(Parts, a_log_too_short_for_parts_is_densified_as_one) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  densify_both(folder, 4);
  EXPECT_TRUE(file_bytes(folder / "one.rawlog") == file_bytes(folder / "parts.rawlog"));
}

TEST(Parts, a_damaged_log_and_pictures_are_refused_and_nothing_is_left) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog", three_parts_long());
  const auto expect_refused = [&](const std::string& more, const std::string& words) {
    const std::size_t num_before = num_files(folder.path());
    const ToolResult result = run_for_errors(
        densify_command(folder / "in.rawlog", folder / "out.rawlog", "--jobs 2 " + more));
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.text, words)) << result.text;
    EXPECT_EQ(num_files(folder.path()), num_before);
  };
  expect_refused("--pictures " + folder / "pictures", "--jobs 1");
  std::filesystem::resize_file(folder / "in.rawlog",
                               std::filesystem::file_size(folder / "in.rawlog") * 3 / 4);
  expect_refused("", "--accept-truncated");
}

/// The track that lies ahead at an image, and where.
std::map<std::int64_t, nlohmann::json> leads_of(const nlohmann::json& report) {
  std::map<std::int64_t, nlohmann::json> leads;
  for (const nlohmann::json& object : report["objects"])
    if (object["moving"] == true && std::abs(object["position_m"][1].get<double>()) < 1.5)
      leads[object["stamp"].get<std::int64_t>()] = object;
  return leads;
}

TEST(Parts, across_a_seam_an_object_keeps_its_number_and_lies_where_it_lay) {
  const TestFolder folder;
  simulate(folder,
           "[scenario]\nduration_s = 8.2\n[camera.CAM0]\nrate_hz = 15\n"
           "[log]\nformat = sensory_frames\n");
  densify_both(folder, 2);
  expect_one_log(folder);
  const auto one = leads_of(report_at(folder / "one.json"));
  const auto parts = leads_of(report_at(folder / "parts.json"));
  ASSERT_GT(one.size(), 50U);
  EXPECT_EQ(one.size(), parts.size());
  std::set<int> tracks;
  for (const auto& [stamp, object] : parts) {
    tracks.insert(object["track"].get<int>());
    ASSERT_EQ(one.count(stamp), 1U);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(object["position_m"][axis].get<double>(),
                  one.at(stamp)["position_m"][axis].get<double>(), 1e-3);
  }
  EXPECT_EQ(tracks.size(), 1U);
}

}  // namespace
}  // namespace lidar_upsampling
