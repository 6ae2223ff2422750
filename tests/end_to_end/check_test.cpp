// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "bad_observations.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

std::string check_command(const TestFolder& folder, const std::string& more = "") {
  return std::string(RAWLOG_DENSIFY) + " --check --input " + folder / "in.rawlog" + " " + more;
}

// Of the line that ends in "camera_time_offset_ms = <ms> (in force: ...)".
double offset_told_ms(const std::string& text) {
  const std::string key = "camera_time_offset_ms = ";
  const auto at = text.find(key);
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? 1e9 : std::stod(text.substr(at + key.size()));
}

constexpr const char* kLateCamera = R"(
[scenario]
duration_s = 1.2
[lidar]
columns = 900
[camera.CAM0]
width = 828
height = 250
rate_hz = 10
time_offset_ms = 12
)";

TEST(Check, streams_views_and_a_known_time_offset_are_told) {
  const TestFolder folder;
  simulate(folder, kLateCamera);
  const ToolResult result = run(check_command(folder, "--pictures " + folder / "pictures"));
  ASSERT_EQ(result.status, 0) << result.text;
  for (const char* const words :
       {"stream        LIDAR", "stream        CAM0", "ego-motion    poses", "32 rings",
        "828 x 250 px", "times of points not known", "in view       CAM0 sees"})
    EXPECT_TRUE(contains(result.text, words)) << words << " is not in: " << result.text;
  EXPECT_NEAR(offset_told_ms(result.text), 12, 2.5);
  EXPECT_TRUE(contains(result.text,
                       "verdict       not fit: no image falls between two scans, with --set "
                       "timing.camera_time_offset_ms=1"))
      << result.text;
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/overlay_CAM0.png"));
}

TEST(Check, ego_motion_that_the_log_lacks_is_measured_between_scans) {
  const TestFolder folder;
  simulate(folder, std::string(kLateCamera) + "[ego_poses]\nkind = none\n");
  const ToolResult result = run(check_command(folder));
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(contains(result.text, "ego-motion    camera")) << result.text;
  EXPECT_NEAR(offset_told_ms(result.text), 12, 2.5);
}

TEST(Check, a_vehicle_at_rest_cannot_tell_the_time_offset) {
  const TestFolder folder;
  simulate(folder, "[ego]\nspeed_mps = 0\n");
  const ToolResult result = run(check_command(folder));
  ASSERT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(contains(result.text, "cannot be told")) << result.text;
  EXPECT_TRUE(contains(result.text, "verdict       fit as it is\n")) << result.text;
}

TEST(Check, a_sweep_with_the_times_of_its_points_is_noticed) {
  const TestFolder folder;
  simulate(folder, "[lidar]\nsweep = true\n[log]\ncarrier = velodyne\n");
  const ToolResult result = run(check_command(folder));
  EXPECT_TRUE(contains(result.text, "times of points known")) << result.text;
  expect_done(
      densify_command(folder / "in.rawlog", folder / "out.rawlog", "--set scan_time=points"));
  const ToolResult as_one = run(check_command(folder, "--set scan_time=none"));
  EXPECT_TRUE(contains(as_one.text, "times of points known, not used")) << as_one.text;
}

TEST(Check, a_log_no_picture_of_which_can_be_used_is_not_fit) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  std::vector<RawlogEntry> entries = read_log(folder / "in.rawlog");
  for (RawlogEntry& entry : entries)
    if (const auto image = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(entry.object)) {
      image->cameraPose.x(kNoNumber);
      entry = entry_of(image);
    }
  write_entries(folder / "in.rawlog", entries);
  const ToolResult result = run(check_command(folder));
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(contains(result.text, "verdict       not fit: no picture can be used with a scan"))
      << result.text;
}

TEST(Check, an_input_is_asked_for) {
  EXPECT_EQ(run(std::string(RAWLOG_DENSIFY) + " --check").status, 2);
}

}  // namespace
}  // namespace lidar_upsampling
