// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "lidar_upsampling/tracks/object_tracks.h"

#include "tracks/car_on_pictures.h"
#include "tracks/objects_scan.h"
#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;

ScanObject car_at(double x, double y) {
  ScanObject car;
  car.points.resize(5);  // too few to be registered
  car.centroid = {x, y, 0.};
  car.length = 4;
  return car;
}

/// Scans of a vehicle at rest that show these objects; nothing can be registered.
class Street {
 public:
  /// @param points of the first object; else all lie at its centroid.
  std::vector<int> show(double time_s, std::vector<ScanObject> objects,
                        const std::vector<Eigen::Vector3f>& points = {}) {
    scan_.stamp = shifted(kStart, time_s);
    scan_.points.clear();
    for (ScanObject& object : objects) {
      std::fill(object.points.begin(), object.points.end(), static_cast<int>(scan_.points.size()));
      scan_.points.emplace_back(object.centroid.cast<float>());
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      objects.front().points[i] = static_cast<int>(scan_.points.size());
      scan_.points.push_back(points[i]);
    }
    return take_up_scan(store_, objects, {scan_, T_rest_lidar_, step_covariance_, seen_}, {});
  }
  /// From now on scans see as far as that.
  void see_as_far_as(double range_m) {
    seen_ = std::make_shared<const SeenSpace>(testing::wall_at(range_m));
  }
  [[nodiscard]] int id(int track) const { return store_.tracks[track].id; }
  [[nodiscard]] ObjectTrack& track(int index) { return store_.tracks[index]; }
  [[nodiscard]] std::size_t num_tracks() const { return store_.tracks.size(); }

 private:
  LidarScan scan_;
  Pose T_rest_lidar_ = Pose::Identity();
  Matrix6d step_covariance_ = Matrix6d::Zero();
  std::shared_ptr<const SeenSpace> seen_ = testing::unknown_space();
  TrackStore store_;
};

TEST(Association, keeps_an_object_at_40_metres_per_second_from_its_second_sight_on) {
  Street street;
  const int id = street.id(street.show(0, {car_at(30, 5)})[0]);
  for (int scan = 1; scan < 5; ++scan)
    EXPECT_EQ(street.id(street.show(0.1 * scan, {car_at(30 - 4 * scan, 5)})[0]), id);
}

TEST(Association, keeps_cars_that_are_parked_side_by_side_apart) {
  Street street;
  const auto before = street.show(0, {car_at(20, 0), car_at(20, 2.5), car_at(20, 5)});
  const int first = street.id(before[0]), last = street.id(before[2]);
  const auto after = street.show(0.1, {car_at(20, 5), car_at(20, 2.5), car_at(20, 0)});
  EXPECT_EQ(street.id(after[0]), last);
  EXPECT_EQ(street.id(after[2]), first);
}

TEST(Association, does_not_take_what_comes_into_sight_far_away_for_what_has_gone) {
  Street street;
  const int gone = street.id(street.show(0, {car_at(20, 0)})[0]);
  EXPECT_NE(street.id(street.show(0.1, {car_at(60, 20)})[0]), gone);
}

TEST(Association, finds_a_mover_again_that_was_hidden_for_three_scans) {
  Street street;
  std::vector<int> seen;
  for (int scan = 0; scan < 4; ++scan) seen = street.show(0.1 * scan, {car_at(30 - 1.5 * scan, 5)});
  const int id = street.id(seen[0]);
  street.see_as_far_as(5);
  for (int scan = 4; scan < 7; ++scan) street.show(0.1 * scan, {});
  EXPECT_EQ(street.id(street.show(0.7, {car_at(30 - 1.5 * 7, 5)})[0]), id);
}

TEST(Association, finds_a_mover_again_of_which_a_sliver_comes_out_from_behind_another) {
  Street street;
  std::vector<int> seen;
  for (int scan = 0; scan < 4; ++scan) seen = street.show(0.1 * scan, {car_at(30 - 1.5 * scan, 5)});
  const int id = street.id(seen[0]);
  street.show(0.4, {});
  ScanObject sliver = car_at(30 - 1.5 * 5 - 1.7, 5);  // its front
  sliver.points.resize(1);
  sliver.length = 0.6;
  EXPECT_EQ(street.id(street.show(0.5, {sliver})[0]), id);
}

TEST(Association, knows_a_sliver_again_of_which_more_is_seen_only_where_it_may_be_an_end_of_that) {
  for (const double apart : {1.5, 4.}) {
    Street street;
    ScanObject sliver = car_at(20, 5);
    sliver.length = 0.5;
    ObjectTrack& parked = street.track(street.show(0, {sliver})[0]);
    parked.log_odds = parked.latest_log_odds = -8;
    const int id = parked.id;
    EXPECT_EQ(street.id(street.show(0.1, {car_at(20 + apart, 5)})[0]) == id, apart < 2);
  }
}

TEST(Association, takes_what_lies_on_it_for_a_part_of_it) {
  const std::vector<Eigen::Vector3f> side{
      {28, 5, -1}, {29, 5, 0}, {30, 5, -1}, {31, 5, 0}, {32, 5, -1}};
  for (const bool lies_on_it : {true, false}) {
    Street street;
    std::vector<int> seen;
    ScanObject car = car_at(30, 5);
    car.centroid.z() = -1;
    for (int scan = 0; scan < 4; ++scan) seen = street.show(0.1 * scan, {car}, side);
    const int id = street.id(seen[0]);
    ScanObject roof = car_at(31.5, 5);  // above something nearer
    roof.points.resize(1);
    roof.length = 0.3;
    roof.centroid = {31.4, 5, lies_on_it ? 0.1 : 1.5};
    EXPECT_EQ(street.id(street.show(0.4, {roof}, {roof.centroid.cast<float>()})[0]) == id,
              lies_on_it);
  }
}

TEST(Association, forgets_a_mover_that_scans_see_through_sooner_than_one_that_is_hidden) {
  for (const bool is_open : {false, true}) {
    Street street;
    std::vector<int> seen;
    for (int scan = 0; scan < 4; ++scan) seen = street.show(0.1 * scan, {car_at(30 - scan, 5)});
    const int id = street.id(seen[0]);
    street.see_as_far_as(is_open ? 50 : 5);
    for (int scan = 4; scan < 8; ++scan) street.show(0.1 * scan, {});
    EXPECT_EQ(street.id(street.show(0.8, {car_at(22, 5.5)})[0]) == id, !is_open);
  }
}

TEST(Association, forgets_an_object_of_which_nothing_is_known_any_more) {
  Street street;
  street.show(0, {car_at(30, 5)});
  street.show(1, {});
  EXPECT_EQ(street.num_tracks(), 0U);
}

TEST(Association, follows_a_wrong_prior_no_longer_than_to_the_next_scan) {
  Street street;
  const auto first = street.show(0, {car_at(30, 5)});
  ObjectTrack& track = street.track(first[0]);
  track.latest.mean[3] = track.state.mean[3] = 10;  // it is said to drive off...
  track.latest.covariance(3, 3) = track.state.covariance(3, 3) = 0.01;
  track.latest_log_odds = track.log_odds = 3;
  const int id = track.id;
  const auto second = street.show(0.1, {car_at(30, 5)});  // ...and does not
  EXPECT_EQ(street.id(second[0]), id);
  EXPECT_LT(street.track(second[0]).log_odds, 2);
}

TEST(Association, goes_on_as_scans_have_shown_where_pictures_told_another_way) {
  Street street;
  std::vector<int> seen;
  for (int scan = 0; scan < 5; ++scan) seen = street.show(0.1 * scan, {car_at(30 - scan, 5)});
  ObjectTrack& track = street.track(seen[0]);
  const int id = track.id;
  track.latest.stamp = shifted(track.stamp, 0.05);
  track.latest.mean.head<3>() << 0, 1, 0;  // to the side, and surely so
  track.latest.mean.segment<2>(3) << 0, 20;
  track.latest.covariance.setIdentity();
  track.latest.covariance *= 1e-4;
  const auto after = street.show(0.5, {car_at(25, 5)});
  EXPECT_EQ(street.id(after[0]), id);
  EXPECT_GT(street.track(after[0]).log_odds, 0);
  EXPECT_NEAR(street.track(after[0]).state.velocity().x(), -10, 1.5);
  EXPECT_NEAR(street.track(after[0]).state.velocity().y(), 0, 1.5);
}

TEST(Association, sees_by_scans_what_moves_where_all_pictures_hold_it_for_standing) {
  Street street;
  std::vector<int> seen;
  for (int scan = 0; scan < 8; ++scan) {
    seen = street.show(0.1 * scan, {car_at(30 - 0.8 * scan, 5)});
    ObjectTrack& track = street.track(seen[0]);
    track.latest = track.state;
    track.latest.stamp = shifted(track.stamp, 0.05);
    track.latest.mean.setZero();
    track.latest.covariance.setIdentity();
    track.latest.covariance *= 0.01;
    track.latest_log_odds = track.log_odds - 0.3;
  }
  EXPECT_GT(street.track(seen[0]).log_odds, 0);
  EXPECT_NEAR(street.track(seen[0]).state.velocity().x(), -8, 2);
}

}  // namespace
}  // namespace lidar_upsampling
