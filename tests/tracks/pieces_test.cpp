// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/tracks/object_tracks.h"

#include "tracks/car_on_pictures.h"
#include "tracks/objects_scan.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;

/// A scan of one wall of a bus along x, in pieces.
struct BusScan : testing::ObjectsScan {
  /// @param pieces where each begins, and its length.
  BusScan(double time_s, const std::vector<std::pair<double, double>>& pieces) {
    scan.stamp = shifted(kStart, time_s);
    for (const auto& [begin, length] : pieces) {
      ScanObject piece;
      for (double x = begin; x < begin + length; x += 0.2) {
        piece.points.push_back(static_cast<int>(scan.points.size()));
        scan.points.emplace_back(static_cast<float>(x), 5.F, 0.F);
      }
      piece.centroid = {begin + 0.5 * length, 5, 0};
      piece.length = length;
      objects.push_back(piece);
    }
  }
};

/// The track of the second piece of a bus that has been seen whole for some scans.
ObjectTrack second_piece_of_bus(double speed_m_s) {
  TrackStore store;
  for (int i = 0; i < 4; ++i) BusScan(0.1 * i, {{20 + 0.1 * i * speed_m_s, 2.}}).take_up(store);
  BusScan broken(0.4, {{20 + 0.4 * speed_m_s, 2.}, {22.5 + 0.4 * speed_m_s, 4.}});
  return store.tracks[broken.take_up(store)[1]];
}

TEST(Pieces, of_what_moves_move_as_the_whole_does) {
  const ObjectTrack piece = second_piece_of_bus(10);
  EXPECT_EQ(piece.id, 1);
  EXPECT_GT(piece.log_odds, 1);
  EXPECT_NEAR(piece.expected_at(shifted(kStart, 0.5), {}).mean[0], 1, 0.1);
}

/// What a scan shows of a bus of 6 m in two pieces that was seen whole for some scans.
BusScan broken_bus(double speed_m_s, double second_at_m) {
  TrackStore store;
  for (int i = 0; i < 4; ++i) BusScan(0.1 * i, {{20 + 0.1 * i * speed_m_s, 6.}}).take_up(store);
  const double x = 20 + 0.4 * speed_m_s;
  BusScan broken(0.4, {{x, 4.}, {x + second_at_m, 1.}});
  broken.take_up(store);
  return broken;
}

TEST(Pieces, that_lie_where_a_mover_was_predicted_are_that_mover) {
  const BusScan broken = broken_bus(10, 4.6);
  ASSERT_EQ(broken.objects.size(), 1U);
  EXPECT_EQ(broken.objects[0].points.size(), broken.scan.points.size());
  EXPECT_NEAR(broken.objects[0].centroid.x(), mean_of(broken.scan.points).x(), 1e-4);
  EXPECT_NEAR(broken.objects[0].length, 5.6, 0.1);
}

TEST(Pieces, that_were_taken_for_something_parked_are_the_mover_in_whose_place_they_lie) {
  TrackStore store;
  for (int i = 0; i < 4; ++i) BusScan(0.1 * i, {{20. + i, 6.}, {29.1, 1.}}).take_up(store);
  ASSERT_EQ(store.tracks.size(), 2U);
  BusScan broken(0.4, {{24, 4.}, {28.8, 1.2}});
  const std::vector<int> track_of = broken.take_up(store);
  ASSERT_EQ(broken.objects.size(), 1U);
  EXPECT_EQ(broken.objects[0].points.size(), broken.scan.points.size());
  EXPECT_EQ(store.tracks[track_of[0]].id, 0);
}

TEST(Pieces, that_lie_elsewhere_stay_objects_of_their_own) {
  EXPECT_EQ(broken_bus(10, 7).objects.size(), 2U);
  EXPECT_EQ(broken_bus(0, 4.6).objects.size(), 2U) << "beside something parked";
}

TEST(Pieces, may_be_something_else) {
  const std::vector<Course> courses = second_piece_of_bus(10).beginnings;
  ASSERT_EQ(courses.size(), 4U);
  double sum = 0;
  for (const Course& course : courses) sum += course.probability;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_LT(courses.front().probability, 0.99);
}

TEST(Pieces, are_hardly_told_of_a_bus_that_scans_have_missed) {
  const auto goes_as_bus = [](int num_missed) {
    TrackStore store;
    for (int i = 0; i < 4; ++i) BusScan(0.1 * i, {{20. + i, 2.}}).take_up(store);
    for (int i = 4; i < 4 + num_missed; ++i) BusScan(0.1 * i, {{60., 2.}}).take_up(store);
    BusScan later(0.1 * (4 + num_missed), {{60., 2.}, {26.5 + num_missed, 1.}});
    double probability = 0;
    for (const Course& course : store.tracks[later.take_up(store)[1]].beginnings)
      if (std::abs(course.from.velocity().x() - 10) < 2) probability += course.probability;
    return probability;
  };
  EXPECT_GT(goes_as_bus(1), 0.5);
  EXPECT_LT(goes_as_bus(3), 0.1);
}

TEST(Pieces, go_as_pictures_tell_though_the_whole_goes_otherwise) {
  ObjectTrack piece = second_piece_of_bus(10);
  piece.latest = predicted(piece.latest, shifted(piece.stamp, 0.1), {});
  piece.latest.mean.segment<2>(3) << -12, 1;
  piece.latest.covariance.block<2, 2>(3, 3) = Eigen::Matrix2d::Identity();
  piece.latest_log_odds = 7;
  double as_told = 0;
  for (const Course& course : courses_of(piece, {}))
    if (course.from.velocity().x() < -11) as_told += course.probability;
  EXPECT_GT(as_told, 0.9);
}

TEST(Pieces, are_not_told_of_what_comes_into_sight_beside_a_parked_bus) {
  const ObjectTrack piece = second_piece_of_bus(0);
  EXPECT_EQ(piece.id, 1);
  EXPECT_NEAR(piece.log_odds, log_odds_of(TrackOptions{}.moving_prior), 0.3);
  EXPECT_GT(piece.state.covariance(3, 3), 100);
}

}  // namespace
}  // namespace lidar_upsampling
