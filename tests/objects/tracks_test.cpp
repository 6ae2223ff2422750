// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/tracks.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

using Places = std::vector<std::optional<Place>>;

Stamp at(double seconds) { return shifted(Stamp(), 1000 + seconds); }

Detection seen_at(double u, const char* class_name = "car") {
  return {{u - 50, 100, u + 50, 160}, class_name, 1., -1, {}};
}

TEST(Tracker, an_object_keeps_its_id_and_shows_its_velocity) {
  int next_id = 7;
  Tracker tracker({}, next_id);
  for (int i = 0; i < 5; ++i) {
    const Place place{Eigen::Vector3d(10 + i, 2, 0)};
    const auto ids = tracker.update(at(0.1 * i), {seen_at(300 + 20 * i)}, {place});
    EXPECT_EQ(ids, std::vector<int>{7});
  }
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_NEAR(tracker.tracks()[0].velocity.x(), 10, 1e-3);
  EXPECT_EQ(tracker.tracks()[0].age, 5);
  EXPECT_EQ(next_id, 8);
}

TEST(Tracker, ids_stay_when_objects_cross_on_the_picture) {
  for (const bool with_places : {true, false}) {
    int next_id = 0;
    Tracker tracker({}, next_id);
    for (int i = 0; i <= 20; ++i) {
      const double to_the_right = 200 + 20. * i;
      const double to_the_left = 610 - 20. * i;
      Places places;
      if (with_places)
        places = {Place{Eigen::Vector3d(10, 5 - 0.5 * i, 0)},
                  Place{Eigen::Vector3d(20, -5 + 0.5 * i, 0)}};
      // Their order in the list changes, too.
      std::vector<Detection> detections{seen_at(to_the_right), seen_at(to_the_left)};
      const bool swapped = i % 2 == 1;
      if (swapped) {
        std::swap(detections[0], detections[1]);
        if (with_places) std::swap(places[0], places[1]);
      }
      const auto ids = tracker.update(at(0.1 * i), detections, places);
      EXPECT_EQ(ids, (swapped ? std::vector<int>{1, 0} : std::vector<int>{0, 1})) << "image " << i;
    }
  }
}

TEST(Tracker, boxes_on_each_other_far_apart_in_depth_are_two_objects) {
  int next_id = 0;
  Tracker tracker({}, next_id);
  tracker.update(at(0), {seen_at(300)}, {Place{Eigen::Vector3d(10, 0, 0)}});
  EXPECT_EQ(tracker.update(at(0.1), {seen_at(300)}, {Place{Eigen::Vector3d(30, 0, 0)}}),
            std::vector<int>{1});
}

TEST(Tracker, a_small_piece_beside_a_vehicle_does_not_take_its_identity) {
  int next_id = 0;
  Tracker tracker({}, next_id);
  tracker.update(at(0), {seen_at(300), seen_at(340)},
                 {Place{Eigen::Vector3d(10, 0, 0), 80}, Place{Eigen::Vector3d(11, 0, 0), 10}});
  // The vehicle has come to where the piece was, which is not seen any more.
  EXPECT_EQ(tracker.update(at(0.1), {seen_at(340)}, {Place{Eigen::Vector3d(11.2, 0, 0), 70}}),
            std::vector<int>{0});
}

TEST(Tracker, a_track_survives_a_few_misses_and_no_more) {
  TrackerOptions options;
  options.max_misses = 2;
  int next_id = 0;
  Tracker tracker(options, next_id);
  tracker.update(at(0), {seen_at(300)});
  for (int i = 1; i <= 2; ++i) tracker.update(at(0.1 * i), {});
  EXPECT_EQ(tracker.update(at(0.3), {seen_at(300)}), std::vector<int>{0});
  for (int i = 4; i <= 6; ++i) tracker.update(at(0.1 * i), {});
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_EQ(tracker.update(at(0.7), {seen_at(300)}), std::vector<int>{1});
}

TEST(Tracker, a_prediction_given_finds_what_constant_velocity_would_lose) {
  int next_id = 0;
  Tracker tracker({}, next_id);
  tracker.update(at(0), {seen_at(300)});
  std::map<int, TrackPrediction> predictions;
  predictions[0] = {seen_at(600).box, std::nullopt};
  EXPECT_EQ(tracker.update(at(0.1), {seen_at(605)}, {}, predictions), std::vector<int>{0});
}

TEST(Tracker, the_detectors_own_identity_wins_over_place) {
  int next_id = 0;
  Tracker tracker({}, next_id);
  std::vector<Detection> detections{seen_at(300), seen_at(500)};
  detections[0].external_track = 40;
  detections[1].external_track = 41;
  tracker.update(at(0), detections);
  std::swap(detections[0].box, detections[1].box);
  EXPECT_EQ(tracker.update(at(0.1), detections), (std::vector<int>{0, 1}));
  detections[0].external_track = 42;
  EXPECT_EQ(tracker.update(at(0.2), detections), (std::vector<int>{2, 1}));
}

TEST(Tracker, cameras_share_the_counter_of_ids) {
  int next_id = 0;
  Tracker left({}, next_id);
  Tracker right({}, next_id);
  EXPECT_EQ(left.update(at(0), {seen_at(300)}), std::vector<int>{0});
  EXPECT_EQ(right.update(at(0), {seen_at(300)}), std::vector<int>{1});
}

TEST(Tracker, places_of_another_number_than_detections_are_refused) {
  int next_id = 0;
  Tracker tracker({}, next_id);
  EXPECT_THROW(tracker.update(at(0), {seen_at(300)}, Places(2)), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
