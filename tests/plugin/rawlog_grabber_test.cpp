// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cstdlib>

#include "lidar_upsampling/io/images.h"
#include "plugin/recording.h"

namespace lidar_upsampling {
namespace {

TEST_F(RawlogGrabber, records_every_real_observation_unchanged_and_a_virtual_scan_per_image) {
  expect_done(std::string(RAWLOG_SIMULATE) +
              " --scenario " CONFIG_FOLDER "/scenarios/small.ini --output " +
              folder_ / "in.rawlog");
  const std::string words = grab("'s/^speed = .*/speed = 0/'");
  ASSERT_NE(recording(), "") << words;
  const auto real = observations_of(folder_ / "in.rawlog");
  const auto all = observations_of(recording());
  expect_same(without_label(all, "LIDAR_VIRTUAL"), real);
  expect_in_time_order(all);
  // Of the 30 images a second, those that do not fall on one of the 10 scans.
  const auto made = with_label(all, "LIDAR_VIRTUAL");
  EXPECT_EQ(made.size(), 20U);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].label() == "LIDAR_VIRTUAL" && i > 0) {
      EXPECT_EQ(all[i].stamp(), all[i - 1].stamp());
    }
  EXPECT_TRUE(contains(words, "20 virtual scans")) << words;
  EXPECT_TRUE(contains(words, "dropped as late: 0 virtual scans, 0 key scans")) << words;
}

TEST_F(RawlogGrabber, at_real_time_what_is_late_is_counted_and_nothing_real_is_lost) {
  simulate(folder_);
  const std::string words = grab("'s/^max_queue = .*/max_queue = 1/'");
  const auto all = observations_of(recording());
  expect_same(without_label(all, "LIDAR_VIRTUAL"), observations_of(folder_ / "in.rawlog"));
  expect_in_time_order(all);
  const std::string before = "dropped as late: ";
  const auto at = words.find(before);
  ASSERT_NE(at, std::string::npos) << words;
  const auto num_late = std::strtoul(words.c_str() + at + before.size(), nullptr, 10);
  EXPECT_LE(with_label(all, "LIDAR_VIRTUAL").size(), 8U);
  EXPECT_GE(with_label(all, "LIDAR_VIRTUAL").size() + num_late, 8U) << words;
}

TEST_F(RawlogGrabber, sensory_frames_hold_every_real_observation_too) {
  simulate(folder_);
  const std::string words =
      grab("-e 's/^speed = .*/speed = 0/' -e 's/^use_sensoryframes = .*/use_sensoryframes = 1/'");
  const auto all = observations_of(recording());
  EXPECT_EQ(without_label(all, "LIDAR_VIRTUAL").size(),
            observations_of(folder_ / "in.rawlog").size())
      << words;
  EXPECT_EQ(with_label(all, "LIDAR_VIRTUAL").size(), 8U) << words;
}

TEST_F(RawlogGrabber, external_images_of_the_played_log_are_found_beside_the_recording) {
  simulate(folder_);
  expect_done("cd " + folder_.path().string() +
              " && rawlog-edit --externalize -i in.rawlog -o out.rawlog && mv out.rawlog in.rawlog "
              "&& mv out_Images in_Images");
  const std::string words = grab("'s/^speed = .*/speed = 0/'");
  const auto all = observations_of(recording());
  EXPECT_EQ(with_label(all, "LIDAR_VIRTUAL").size(), 8U) << words;
  for (const Logged& logged : with_label(all, "CAM0")) {
    auto& image = dynamic_cast<mrpt::obs::CObservationImage&>(*logged.observation);
    EXPECT_TRUE(image.image.isExternallyStored());
    EXPECT_EQ(image_from_observation(image).gray.cols, 414);
  }
}

TEST_F(RawlogGrabber, a_misspelt_key_is_refused_by_its_name) {
  simulate(folder_);
  const std::string words = grab("'s/^max_queue = /max_que = /'");
  EXPECT_TRUE(contains(words, "(UPSAMPLED_LIDAR) max_que: there is no such setting")) << words;
}

}  // namespace
}  // namespace lidar_upsampling
