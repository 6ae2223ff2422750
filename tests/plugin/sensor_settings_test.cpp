// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/sensor_settings.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

namespace lidar_upsampling {
namespace {

constexpr const char* kFile = R"(
[global]
use_sensoryframes = 1
[UPSAMPLED]
driver = UpsampledLidarSensor
process_rate = 100
sensorLabel = X
rawlog = a b.rawlog
speed = 2.5
max_wait_ms = 70
linger_s = 3
lidar_label = TOP
outside_view = drop
[klt]
rawlog-grabber-ignore = true
window_px = 21
[camera.CAM0]
rawlog-grabber-ignore = true
fx_px = 700
[OTHER]
driver = CGPSInterface
whatever = 1
[DISABLED]
rawlog-grabber-ignore = true
driver = CGPSInterface
)";

SensorSettings load(const std::string& more_lines) {
  mrpt::config::CConfigFileMemory file;
  file.setContent(std::string(kFile) + more_lines);
  return load_sensor_settings(file, "UPSAMPLED");
}

// The message that more lines are refused with.
std::string refusal(const std::string& more_lines) {
  try {
    static_cast<void>(load(more_lines));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& more_lines, const std::vector<std::string>& words) {
  const std::string message = refusal(more_lines);
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << word << " is not in: " << message;
}

TEST(SensorSettings, points_are_only_moved_unless_more_is_asked_for) {
  EXPECT_EQ(load("").config.resample, "none");
  EXPECT_EQ(load("[UPSAMPLED]\nresample = beam\n").config.resample, "beam");
  EXPECT_LT(load("").config.point_tracks.max_points_per_object,
            Config().point_tracks.max_points_per_object);
}

TEST(SensorSettings, the_sensors_and_the_methods_settings_are_read_from_one_file) {
  const SensorSettings settings = load("");
  EXPECT_EQ(settings.rawlog, "a b.rawlog");
  EXPECT_EQ(settings.speed, 2.5);
  EXPECT_EQ(settings.max_wait_ms, 70);
  EXPECT_EQ(settings.linger_s, 3);
  EXPECT_TRUE(settings.into_frames);
  EXPECT_EQ(settings.config.lidar_label, "TOP");
  EXPECT_EQ(settings.config.klt.window_px, 21);
  EXPECT_EQ(settings.rig.cameras.at("CAM0").fx, 700);
}

TEST(SensorSettings, sources_are_a_list) {
  const SensorSettings settings = load("[UPSAMPLED]\nrawlog =\nsources = FRONT, TOP ,GPS\n");
  EXPECT_EQ(settings.sources, (std::vector<std::string>{"FRONT", "TOP", "GPS"}));
}

TEST(SensorSettings, a_misspelt_key_is_refused_by_its_name) {
  expect_refused("[UPSAMPLED]\nmax_wait = 3\n", {"[UPSAMPLED]", "max_wait:", "max_wait_ms"});
  expect_refused("[klt]\nwindow_pixels = 3\n", {"[klt]", "window_pixels", "window_px"});
  expect_refused("[camera.CAM0]\nfocal = 3\n", {"[camera.CAM0]", "focal", "fx_px"});
}

TEST(SensorSettings, a_misspelt_section_is_refused_by_its_name) {
  expect_refused("[tming]\nrawlog-grabber-ignore = true\nmin_gap_ms = 20\n", {"[tming]", "timing"});
}

TEST(SensorSettings, a_value_out_of_range_is_refused) {
  expect_refused("[UPSAMPLED]\nspeed = -1\n", {"[UPSAMPLED]", "speed", "-1"});
  expect_refused("[UPSAMPLED]\nmax_wait_ms = -1\n", {"max_wait_ms", "-1"});
  expect_refused("[UPSAMPLED]\nlinger_s = soon\n", {"linger_s", "soon"});
}

TEST(SensorSettings, a_mode_that_needs_the_future_is_refused) {
  expect_refused("[UPSAMPLED]\nmode = offline\n", {"[UPSAMPLED]", "mode", "offline", "causal"});
}

TEST(SensorSettings, poses_of_a_file_are_refused_unless_a_log_is_played) {
  const std::string poses = "[ego_motion]\nrawlog-grabber-ignore = true\nposes_file = a.tum\n";
  EXPECT_EQ(load(poses).config.pose_file.path, "a.tum");
  expect_refused("[UPSAMPLED]\nrawlog =\nsources = A\n" + poses,
                 {"[ego_motion]", "poses_file", "'a.tum'", "rawlog"});
}

TEST(SensorSettings, a_log_or_drivers_must_be_named_but_not_both) {
  expect_refused("[UPSAMPLED]\nrawlog =\n", {"rawlog, sources"});
  expect_refused("[UPSAMPLED]\nsources = A\n", {"rawlog, sources"});
}

}  // namespace
}  // namespace lidar_upsampling
