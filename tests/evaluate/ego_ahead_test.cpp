// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "rawlog-densify/ego_ahead.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

Stamp log_time(double seconds) {
  return shifted(Stamp(Stamp::duration(132000000000000000LL)), seconds);
}

StreamInfo stream_from(const std::string& label, StreamKind kind, double from_s) {
  StreamInfo info;
  info.label = label;
  info.kind = kind;
  for (int i = 0; i < 100; ++i) info.stamps.push_back(log_time(from_s + 0.1 * i));
  info.count = info.stamps.size();
  return info;
}

class EgoGoesBy : public ::testing::Test {
 protected:
  EgoGoesBy() { streams_.streams.push_back(stream_from("LIDAR", StreamKind::lidar, 0)); }

  void add(StreamKind kind, double from_s = 0) {
    streams_.streams.push_back(
        stream_from("EGO" + std::to_string(streams_.streams.size()), kind, from_s));
  }
  [[nodiscard]] bool goes_by() const { return ego_goes_by(config_, streams_); }

  Config config_;
  LogIndex streams_;
};

TEST_F(EgoGoesBy, where_there_is_none_or_one_stream_from_the_start) {
  EXPECT_TRUE(goes_by());
  add(StreamKind::odometry, 0.2);
  EXPECT_TRUE(goes_by());
  add(StreamKind::gnss);
  EXPECT_TRUE(goes_by());
}

TEST_F(EgoGoesBy, not_where_the_best_comes_late) {
  add(StreamKind::odometry);
  add(StreamKind::pose, 5);
  EXPECT_FALSE(goes_by());
}

TEST_F(EgoGoesBy, not_where_all_of_the_log_tells_which_of_two_counts) {
  add(StreamKind::pose);
  add(StreamKind::pose);
  EXPECT_FALSE(goes_by());
}

TEST_F(EgoGoesBy, not_by_gnss_by_movements_or_from_a_file) {
  add(StreamKind::gnss);
  EXPECT_FALSE(goes_by());
  add(StreamKind::pose);
  EXPECT_TRUE(goes_by());
  streams_.has_frames = true;
  EXPECT_FALSE(goes_by());
  streams_.has_frames = false;
  config_.pose_file.path = "poses.csv";
  EXPECT_FALSE(goes_by());
}

TEST_F(EgoGoesBy, not_over_gaps_that_are_longer_than_what_is_looked_ahead) {
  add(StreamKind::pose);
  config_.ego_motion.max_interpolation_gap_s = 10;
  EXPECT_FALSE(goes_by());
}

TEST_F(EgoGoesBy, where_it_is_the_cameras) {
  add(StreamKind::gnss);
  config_.ego_motion.source = EgoSource::camera;
  EXPECT_TRUE(goes_by());
}

}  // namespace
}  // namespace lidar_upsampling
