// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {
namespace {

std::vector<Detection> detect(Detector& detector, const std::string& label, Stamp stamp) {
  CameraImage image;
  image.stamp = stamp;
  image.camera.label = label;
  return detector.detect(image);
}

std::unique_ptr<Detector> from(const std::string& rows) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / std::to_string(getpid());
  std::filesystem::create_directories(folder);
  CsvDetectorOptions options;
  options.path = folder / "boxes.csv";
  std::ofstream(options.path) << rows;
  return make_csv_detector(options);
}

std::string error_of(const std::string& rows) {
  try {
    static_cast<void>(from(rows));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(ParseStamp, seconds_lose_no_tick) {
  const auto ticks = [](const char* text) { return parse_stamp(text).time_since_epoch().count(); };
  EXPECT_EQ(ticks("1317046450.1234567"), 116444736000000000 + 13170464501234567);
  EXPECT_EQ(ticks("1317046450.12345678"), 116444736000000000 + 13170464501234568);
  EXPECT_EQ(ticks("1317046450.5"), 116444736000000000 + 13170464505000000);
  EXPECT_EQ(ticks("1317046450"), 116444736000000000 + 13170464500000000);
  EXPECT_EQ(ticks("129615200501234567"), 129615200501234567);
  EXPECT_EQ(parse_stamp("1317046450.25"), mrpt::Clock::fromDouble(1317046450.25));
}

TEST(ParseStamp, what_is_neither_ticks_nor_seconds_is_refused) {
  for (const char* text :
       {"", "now", "-3", "1.2.3", "1317046450123", "1317046450123456789", "1e9"}) {
    EXPECT_THROW(static_cast<void>(parse_stamp(text)), std::invalid_argument) << text;
  }
}

TEST(Stamps, lie_apart_and_are_shifted_to_the_tick_and_at_the_ends_of_time_still) {
  const Stamp now = parse_stamp("1317046450.1234567");
  EXPECT_EQ(seconds_between(now, shifted(now, -0.0000003)), -3e-7);
  EXPECT_EQ(seconds_between(Stamp::min(), now), -seconds_between(now, Stamp::min()));
  EXPECT_NEAR(seconds_between(Stamp::min(), Stamp::max()), 1.8447e12, 1e8);
  EXPECT_NEAR(seconds_between(Stamp::max(), Stamp::min()), -1.8447e12, 1e8);
  EXPECT_EQ(shifted(Stamp::max(), 1), Stamp::max());
  EXPECT_EQ(shifted(Stamp::min(), -1), Stamp::min());
  EXPECT_EQ(shifted(now, 1e30), Stamp::max());
}

TEST(CsvDetector, gives_the_boxes_of_the_label_at_the_nearest_stamp) {
  const auto made = from(
      "label,stamp,class,score,left,top,right,bottom,track\r\n"
      "CAM2,100.0,car,0.9,1,2,30,40,5\r\n"
      "CAM2, 100.0, person,,50,2,60,40\n"
      "\n"
      "CAM3,100.0,bus,1,1,2,30,40\n"
      "CAM2,100.1,truck,1,1,2,30,40\n");
  Detector& detector = *made;
  const Stamp stamp = parse_stamp("100.003");
  const auto found = detect(detector, "CAM2", stamp);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].class_name, "car");
  EXPECT_EQ(found[0].score, 0.9);
  EXPECT_EQ(found[0].external_track, 5);
  EXPECT_EQ(found[0].box.bottom, 40);
  EXPECT_EQ(found[1].class_name, "person");
  EXPECT_EQ(found[1].external_track, -1);
  EXPECT_EQ(detect(detector, "CAM2", parse_stamp("100.098")).at(0).class_name, "truck");
  EXPECT_EQ(detect(detector, "CAM3", stamp).size(), 1U);
  EXPECT_TRUE(detect(detector, "CAM4", stamp).empty());
  EXPECT_TRUE(detect(detector, "CAM2", parse_stamp("100.05")).empty());
  EXPECT_TRUE(detect(detector, "CAM2", parse_stamp("200")).empty());
}

TEST(CsvDetector, tells_the_line_of_a_bad_row) {
  const std::string good = "CAM,1.0,car,1,1,2,30,40\n";
  EXPECT_EQ(error_of(good), "none");
  const auto complains = [&](const std::string& row, const std::string& about) {
    const std::string error = error_of(good + row);
    EXPECT_NE(error.find("boxes.csv, line 2: "), std::string::npos) << error;
    EXPECT_NE(error.find(about), std::string::npos) << error;
  };
  complains("CAM,1.0,car,1,1,2,30", "7 columns");
  complains("CAM,1.0,car,1,1,2,30,40,1,1", "10 columns");
  complains("CAM,then,car,1,1,2,30,40", "stamp 'then'");
  complains("CAM,1.0,car,1,one,2,30,40", "left is 'one'");
  complains("CAM,1.0,car,1,1,2,30x,40", "right is '30x'");
  complains("CAM,1.0,car,nan,1,2,30,40", "score is 'nan'");
  complains("CAM,1.0,car,1,30,2,1,40", "box is empty");
  complains("CAM,1.0,car,1,1,2,30,40,1.5", "track is '1.5'");
  complains(std::string("\x1f\x8b\x08\0\n", 5), "no table in text");
}

TEST(CsvDetector, a_missing_file_is_named) {
  DetectorOptions options;
  options.type = DetectorOptions::Type::csv;
  options.csv.path = "/nowhere/boxes.csv";
  try {
    static_cast<void>(make_detector(options));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/boxes.csv"), std::string::npos);
  }
}

}  // namespace
}  // namespace lidar_upsampling
