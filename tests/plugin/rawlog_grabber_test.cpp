// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cstdlib>

#include "end_to_end/hand_made_log.h"
#include "io/damage.h"
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
  EXPECT_TRUE(contains(words, "played to its end")) << words;
  EXPECT_FALSE(contains(words, "ERROR")) << words;
}

TEST_F(RawlogGrabber, at_real_time_what_is_late_is_counted_and_nothing_real_is_lost) {
  simulate(folder_);
  const std::string words = grab("'s/^max_wait_ms = .*/max_wait_ms = 1/'");
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

/// The stock program, in which MRPT is bound already when the module comes.
class DamagedLogInRawlogGrabber : public RawlogGrabber {
 protected:
  void expect_the_rest_recorded(const Bytes& broken) {
    write_hand_made(folder_ / "good.rawlog");
    const auto good = read_log(folder_ / "good.rawlog");
    std::vector<Bytes> parts;
    for (const RawlogEntry& entry : good) parts.push_back(entry.bytes);
    parts.push_back(Bytes(parts.back()));
    write_bytes(folder_ / "rest.rawlog", joined(parts));
    parts.insert(parts.end() - 1, broken);
    write_bytes(folder_ / "in.rawlog", joined(parts));
    const std::string words = grab("'s/^speed = .*/speed = 0/'");
    const std::string told = "broken after " + std::to_string(good.size()) + " good objects";
    EXPECT_TRUE(contains(words, told)) << words;
    const auto all = observations_of(recording());
    expect_same(without_label(all, "LIDAR_VIRTUAL"), observations_of(folder_ / "rest.rawlog"));
  }
};

TEST_F(DamagedLogInRawlogGrabber, a_wild_size_costs_its_object_and_not_the_recording) {
  expect_the_rest_recorded(range_picture_of(0x3fff0000, 1));
}

TEST_F(DamagedLogInRawlogGrabber, a_broken_jpeg_picture_costs_its_object_and_not_the_recording) {
  expect_the_rest_recorded(broken_jpeg());
}

TEST_F(RawlogGrabber, a_misspelt_key_is_refused_by_its_name) {
  simulate(folder_);
  const std::string words = grab("'s/^max_wait_ms = /max_wait = /'");
  EXPECT_TRUE(contains(words, "(UPSAMPLED_LIDAR) max_wait: there is no such setting")) << words;
  EXPECT_EQ(recording(), "");
}

TEST_F(RawlogGrabber, without_its_log_says_so_and_leaves_no_recording) {
  const std::string words = grab("''");
  EXPECT_TRUE(contains(words, "in.rawlog")) << words;
  EXPECT_EQ(recording(), "");
}

TEST_F(RawlogGrabber, of_a_log_that_is_none_says_so_and_leaves_no_recording) {
  std::ofstream(folder_ / "in.rawlog") << "text";
  const std::string words = grab("''");
  EXPECT_TRUE(contains(words, "is no rawlog that can be read")) << words;
  EXPECT_EQ(recording(), "");
}

}  // namespace
}  // namespace lidar_upsampling
