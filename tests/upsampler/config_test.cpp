// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <fstream>
#include <sstream>

#include "lidar_upsampling/config.h"

namespace lidar_upsampling {
namespace {

Config loaded(const std::string& ini) {
  mrpt::config::CConfigFileMemory file;
  file.setContent(ini);
  Config config;
  config.loadFromConfigFile(file, kMainSection);
  return config;
}

std::string error_of(const std::string& ini) {
  try {
    (void)loaded(ini);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

std::string content_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Config, the_default_file_says_what_the_structs_say) {
  EXPECT_EQ(content_of(PROJECT_FOLDER "/config/default.ini"), default_ini())
      << "run: rawlog-densify --print-config > config/default.ini";
}

TEST(Config, loading_the_default_file_changes_nothing) {
  mrpt::config::CConfigFileMemory before, after;
  Config().saveToConfigFile(before, kMainSection);
  loaded(default_ini()).saveToConfigFile(after, kMainSection);
  std::string text_before, text_after;
  before.getContent(text_before);
  after.getContent(text_after);
  EXPECT_EQ(text_before, text_after);
}

TEST(Config, the_kitti_file_loads) {
  EXPECT_DOUBLE_EQ(
      loaded(content_of(PROJECT_FOLDER "/config/kitti.ini")).timing.camera_time_offset_ms, 10.5);
}

TEST(Config, values_are_read) {
  const Config config = loaded(
      "[lidar_upsampling]\nlidar_label = TOP\ncamera_labels = A, B\nobjects = drop\n"
      "[klt]\nwindow_px = 21\n[ego_motion]\nsource = gnss\n[object_motion]\nstatic_test = no\n");
  EXPECT_EQ(config.lidar_label, "TOP");
  EXPECT_EQ(config.camera_labels, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(config.compose.objects, MovingObjects::drop);
  EXPECT_EQ(config.klt.window_px, 21);
  EXPECT_EQ(config.ego_motion.source, EgoSource::gnss);
  EXPECT_FALSE(config.object_tracks.static_test);
}

TEST(Config, gzip_levels_of_former_files_still_mean_something) {
  EXPECT_EQ(loaded("[lidar_upsampling]\ncompression = 0\n").compression, Compression::none);
  EXPECT_EQ(loaded("[lidar_upsampling]\ncompression = 1\n").compression, Compression::fast);
  EXPECT_EQ(loaded("[lidar_upsampling]\ncompression = 9\n").compression, Compression::small);
  EXPECT_EQ(loaded("[lidar_upsampling]\ncompression = small\n").compression, Compression::small);
}

TEST(Config, compression_is_a_word_or_a_format_with_its_level) {
  for (const char* const text : {"none", "fast", "small", "gzip:1", "gzip:9", "zstd:3", "zstd:19"})
    EXPECT_EQ(to_text(parse_compression(text)), text);
  EXPECT_EQ(loaded("[lidar_upsampling]\ncompression = zstd:3\n").compression,
            (Compression{Compression::Format::zstd, 3}));
  EXPECT_EQ(parse_compression("gzip:6"), Compression::small);
  for (const char* const text :
       {"", "zstd", "zstd:", "zstd:0", "zstd:20", "gzip:10", "gzip:1x", "zstd:-1", "lz4:1", "10"})
    EXPECT_NE(error_of("[lidar_upsampling]\ncompression = " + std::string(text) + "\n")
                  .find("zstd:1 to zstd:19"),
              std::string::npos)
        << text;
}

TEST(Config, an_unknown_key_is_named_with_those_there_are) {
  const std::string error = error_of("[klt]\nwindow = 21\n");
  EXPECT_NE(error.find("[klt] window"), std::string::npos) << error;
  EXPECT_NE(error.find("window_px"), std::string::npos) << error;
}

TEST(Config, a_key_that_is_nearly_one_or_one_of_another_section_is_answered_with_that) {
  const std::string nearly = error_of("[klt]\nwindw_px = 21\n");
  EXPECT_NE(nearly.find("; did you mean window_px? There are "), std::string::npos) << nearly;
  const std::string elsewhere = error_of("[lidar_upsampling]\nwindow_px = 21\n");
  EXPECT_NE(elsewhere.find("; did you mean that of [klt]? "), std::string::npos) << elsewhere;
}

TEST(Config, a_bad_value_is_named_with_what_is_expected) {
  EXPECT_NE(error_of("[klt]\nwindow_px = big\n").find("[klt] window_px = 'big': a number"),
            std::string::npos);
  EXPECT_NE(error_of("[klt]\nwindow_px = 7.5\n").find("a whole number"), std::string::npos);
  EXPECT_NE(error_of("[klt]\nwindow_px = 999\n").find("between"), std::string::npos);
  EXPECT_NE(error_of("[klt]\nwindow_px = 10\n").find("[klt] window_px = '10': an odd number"),
            std::string::npos);
  EXPECT_NE(error_of("[lidar_upsampling]\nobjects = hide\n").find("keep, drop"), std::string::npos);
  EXPECT_NE(error_of("[object_motion]\nstatic_test = maybe\n").find("true or false"),
            std::string::npos);
}

TEST(Config, a_misspelt_section_is_named) {
  mrpt::config::CConfigFileMemory file;
  file.setContent("[ktl]\nwindow_px = 21\n[camera.CAM0]\nfx_px = 700\n");
  try {
    check_sections(file);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("[ktl]"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("did you mean klt?"), std::string::npos)
        << error.what();
  }
}

TEST(Config, a_live_sensors_section_may_hold_the_drivers_own_keys) {
  mrpt::config::CConfigFileMemory file;
  file.setContent(
      "[upsampled]\ndriver = UpsampledLidarSensor\nprocess_rate = 50\nobjects = drop\n");
  Config config;
  config.loadFromConfigFile(file, "upsampled");
  EXPECT_EQ(config.compose.objects, MovingObjects::drop);
}

TEST(Config, the_papers_preset_moves_every_object_by_its_own_pose) {
  const Config preset = loaded("[lidar_upsampling]\npreset = paper\n");
  EXPECT_EQ(preset.resample, "none");
  EXPECT_FALSE(preset.point_tracks.own_surface || preset.klt.align_first);
  EXPECT_FALSE(preset.ego_motion.fuse);
  EXPECT_FALSE(preset.object_motion.world_tracks || preset.object_tracks.scan_factor);
  const TrackOptions ours = loaded("").object_tracks;
  EXPECT_TRUE(ours.static_test && ours.scan_factor && ours.image_factor && ours.ground_factor);
}

}  // namespace
}  // namespace lidar_upsampling
