// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "hand_made_log.h"
#include "io/small_logs.h"
#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/compat/point_fields.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

const Bytes kZstd{0x28, 0xb5, 0x2f, 0xfd};

Bytes first_bytes(const std::string& path) {
  Bytes bytes = file_bytes(path);
  bytes.resize(std::min(bytes.size(), kZstd.size()));
  return bytes;
}

/// How often the beginning of a frame is in the file: those of another one are not by chance.
long num_frames(const std::string& path) {
  const Bytes bytes = file_bytes(path);
  long count = 0;
  for (auto at = bytes.begin();; ++at, ++count) {
    at = std::search(at, bytes.end(), kZstd.begin(), kZstd.end());
    if (at == bytes.end()) return count;
  }
}

TEST(PackedLogs, hold_the_same_however_they_are_packed) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_done(
      densify_command(folder / "in.rawlog", folder / "none.rawlog", "--set compression=none"));
  for (const std::string how : {"fast", "small", "gzip:1", "zstd:1", "zstd:19"}) {
    const std::string path = folder / "packed.rawlog";
    expect_done(
        densify_command(folder / "in.rawlog", path, "--overwrite --set compression=" + how));
    EXPECT_TRUE(uncompressed(path) == file_bytes(folder / "none.rawlog")) << how;
    EXPECT_EQ(first_bytes(path) == kZstd, how[0] == 'z') << how;
  }
}

TEST(PackedLogs, of_zstd_go_in_and_parts_of_them_come_out_as_one_frame) {
  const TestFolder folder;
  HandMadeLog log;
  log.num_images = log.num_instants = 390;
  write_hand_made(folder / "gzip.rawlog", log);
  {
    RawlogWriter writer(folder / "in.rawlog", false, parse_compression("zstd:3"));
    for (const RawlogEntry& entry : read_log(folder / "gzip.rawlog")) writer.write(entry);
    writer.commit();
  }
  const std::string three = "--jobs 3 --set compression=";
  expect_done(densify_command(folder / "gzip.rawlog", folder / "a.rawlog", three + "none"));
  expect_done(densify_command(folder / "in.rawlog", folder / "b.rawlog", three + "zstd:3"));
  EXPECT_EQ(num_frames(folder / "b.rawlog"), 1);
  EXPECT_TRUE(uncompressed(folder / "b.rawlog") == file_bytes(folder / "a.rawlog"));
}

TEST(PackedLogs, of_zstd_are_read_by_the_mrpt_that_writes_them_and_its_own_by_us) {
  if (!compat::kReadsZstd || !has_rawlog_edit()) GTEST_SKIP() << "this MRPT knows no zstd";
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  densify(folder, "--set compression=zstd:3");
  expect_done("rawlog-edit --remove-label NONE_OF_THIS_NAME -i " + folder / "out.rawlog" + " -o " +
              folder / "back.rawlog");
  EXPECT_TRUE(first_bytes(folder / "back.rawlog") == kZstd);
  EXPECT_EQ(stamps_of(observations_of(folder / "back.rawlog")),
            stamps_of(observations_of(folder / "out.rawlog")));
}

TEST(PackedLogs, that_end_within_a_frame_are_refused_in_one_line_or_read_as_far_as_they_go) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  densify(folder, "--set compression=zstd:3");
  const auto size = std::filesystem::file_size(folder / "out.rawlog");
  std::filesystem::resize_file(folder / "out.rawlog", size - 20);
  const std::string command = std::string(RAWLOG_DECIMATE) +
                              " --label LIDAR --keep-every 2 --input " + folder / "out.rawlog" +
                              " --output " + folder / "thin.rawlog";
  const ToolResult refused = run_for_errors(command);
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(contains(refused.text, "the zstd stream is cut off")) << refused.text;
  EXPECT_EQ(count_of(refused.text, "\n"), 1) << refused.text;
  expect_done(command + " --accept-truncated");
}

TEST(PackedLogs, that_an_older_mrpt_cannot_read_say_so_and_are_not_made_for_it) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  const auto densified = [&](const std::string& more) {
    return run(densify_command(folder / "in.rawlog", folder / "out.rawlog", "--overwrite " + more));
  };
  const ToolResult told = densified("--set compression=zstd:3");
  EXPECT_EQ(count_of(told.text, "MRPT before 2.15.7 cannot read this log: compression = zstd:3"), 1)
      << told.text;
  EXPECT_FALSE(contains(densified("").text, "cannot read this log"));
  EXPECT_EQ(densified("--for-mrpt 2.5").status, 0);
  EXPECT_EQ(densified("--for-mrpt 2.15.7 --set compression=zstd:3").status, 0);
  for (const std::string release : {"2.5", "2.5.8", "2.15", "2.14.7"}) {
    const ToolResult refused = densified("--set compression=zstd:3 --for-mrpt " + release);
    EXPECT_EQ(refused.status, 1) << release;
    EXPECT_TRUE(contains(refused.text, "needs 2.15.7 or newer")) << refused.text;
  }
  EXPECT_EQ(densified("--set annotate=1 --for-mrpt 2.5").status, compat::kScenesAreNew ? 1 : 0);
  EXPECT_EQ(densified("--for-mrpt new").status, 1);
}

TEST(PackedLogs, of_point_clouds_with_rings_give_the_figures_of_range_scans) {
  if (compat::maps_with_rings_since() == nullptr)
    GTEST_SKIP() << "this MRPT's point clouds know no rings";
  std::vector<nlohmann::json> errors;
  for (const std::string carrier : {"3drangescan", "pointcloud"}) {
    const TestFolder folder;
    simulate(folder, "[log]\ncarrier = " + carrier + "\n");
    densify(folder, "--set carrier=" + carrier);
    errors.push_back(errors_to_truth(folder));
  }
  for (const char* const name :
       {"moving_objects_m", "static_objects_m", "chamfer_m", "chamfer_in_view_m"}) {
    EXPECT_EQ(errors[0][name]["count"], errors[1][name]["count"]) << name;
    const double a = errors[0][name]["mean"], b = errors[1][name]["mean"];
    EXPECT_NEAR(a, b, 0.01 * a) << name;
  }
}

}  // namespace
}  // namespace lidar_upsampling
