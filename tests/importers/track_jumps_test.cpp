// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/track_jumps.h"

#include <gtest/gtest.h>

#include "simulator/scenario.h"

namespace lidar_upsampling::importing {
namespace {

// At 10 Hz, along x.
ObjectTrack labelled_along(int id, const std::vector<double>& x) {
  ObjectTrack track;
  track.id = id;
  for (std::size_t i = 0; i < x.size(); ++i) {
    track.poses.push_back(
        {sim::stamp_of(static_cast<int>(i), 10, 0), Pose(Eigen::Translation3d(x[i], 0, 0))});
  }
  return track;
}

TEST(TrackJumps, of_fast_cars_and_jittering_labels_are_none) {
  // 50 m/s, the first label twice within a tick.
  ObjectTrack fast = labelled_along(4, {0, 5, 10, 15.2, 19.8});
  fast.poses.insert(fast.poses.begin(), fast.poses.front());
  fast.poses.front().T_world_object.translation().x() += 0.1;
  const SteadyTracks steady = without_jumps({fast});
  ASSERT_EQ(steady.tracks.size(), 1U);
  EXPECT_EQ(steady.tracks[0].poses.size(), 6U);
  EXPECT_EQ(warning_of(steady), "");
}

TEST(TrackJumps, a_label_far_from_its_neighbours_is_left_out_wherever_it_is) {
  for (const std::size_t bad : {0U, 2U, 5U}) {
    std::vector<double> x = {0, 1, 2, 3, 4, 5};
    x[bad] += 40;
    const SteadyTracks steady = without_jumps({labelled_along(4, x), labelled_along(6, {9, 9, 9})});
    ASSERT_EQ(steady.tracks.size(), 2U) << bad;
    EXPECT_EQ(steady.tracks[0].poses.size(), 5U) << bad;
    EXPECT_EQ(steady.tracks[0].id, 4) << bad;
    EXPECT_EQ(
        warning_of(steady),
        "1 object with labels that jump by more than 60 m/s: 1 label left out (a number given "
        "to two objects, or misplaced boxes?)");
  }
}

TEST(TrackJumps, a_number_given_to_two_objects_makes_two_tracks) {
  // The second is so far that the first could be there later on.
  std::vector<double> x = {0, 1, 2};
  for (int i = 0; i < 20; ++i) x.push_back(30 + i);
  const SteadyTracks steady = without_jumps({labelled_along(4, x), labelled_along(6, {9, 9, 9})});
  ASSERT_EQ(steady.tracks.size(), 3U);
  EXPECT_EQ(steady.tracks[0].poses.size(), 20U);
  EXPECT_EQ(steady.tracks[0].id, 4);
  EXPECT_EQ(steady.tracks[1].poses.size(), 3U);
  EXPECT_EQ(steady.tracks[1].id, 7);
  EXPECT_EQ(steady.num_split, 1);
  EXPECT_EQ(steady.num_left_out, 0);
}

}  // namespace
}  // namespace lidar_upsampling::importing
