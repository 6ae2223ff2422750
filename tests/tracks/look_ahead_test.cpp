// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include "lidar_upsampling/tracks/object_tracks.h"

#include "tracks/car_on_pictures.h"
#include "tracks/objects_scan.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;

constexpr double kPeriod_s = 0.1;

ScanObject sight_at(double x) {
  ScanObject car;
  car.points.resize(5);  // too few to be registered: its centroid tells
  car.centroid = {x, 5, 0};
  car.length = 1;
  return car;
}

/// Scans of a vehicle at rest, a tenth of a second apart, that show one car here and there.
struct SightsOfOne {
  explicit SightsOfOne(const std::vector<double>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      scans.emplace_back();
      scans.back().stamp = shifted(kStart, kPeriod_s * static_cast<double>(i));
      objects.push_back({sight_at(places[i])});
      scans.back().points.assign(100, objects.back().front().centroid.cast<float>());
    }
  }
  [[nodiscard]] TrackedScan scan(std::size_t i) const {
    return {scans[i], T_rest_lidar, step_covariance, seen};
  }
  /// The car's track at the first scan, with `num_ahead` scans to come.
  [[nodiscard]] ObjectTrack track_of_first(std::size_t num_ahead) const {
    TrackStore store;
    std::vector<ScanObject> first = objects[0];
    take_up_scan(store, first, scan(0), {});
    std::vector<ScanToCome> to_come;
    for (std::size_t i = 1; i <= num_ahead; ++i) to_come.push_back({objects[i], scan(i)});
    look_ahead(store, to_come, {});
    return store.tracks.at(0);
  }

  std::vector<LidarScan> scans;
  std::vector<std::vector<ScanObject>> objects;
  Pose T_rest_lidar = Pose::Identity();
  Matrix6d step_covariance = Matrix6d::Zero();
  std::shared_ptr<const SeenSpace> seen = testing::unknown_space();
};

double speed_expected(const ObjectTrack& track) {
  return track.expected_at(shifted(kStart, 0.05), {}).velocity().x();
}

double variance_expected(const ObjectTrack& track) {
  return track.expected_at(shifted(kStart, 0.05), {}).covariance(0, 0);
}

TEST(LookAhead, tells_how_an_object_moves_that_has_only_been_seen_once) {
  const SightsOfOne street({20, 21, 22, 23});
  EXPECT_EQ(speed_expected(street.track_of_first(0)), 0);
  const ObjectTrack track = street.track_of_first(3);
  EXPECT_NEAR(speed_expected(track), 10, 1);
  EXPECT_GT(track.expected_log_odds(), 2);
}

TEST(LookAhead, is_the_surer_the_more_scans_tell) {
  const SightsOfOne street({20, 21, 22, 23});
  EXPECT_LT(variance_expected(street.track_of_first(1)),
            0.1 * variance_expected(street.track_of_first(0)));
  EXPECT_LT(variance_expected(street.track_of_first(3)),
            0.9 * variance_expected(street.track_of_first(1)));
}

TEST(LookAhead, an_object_that_comes_out_beside_where_it_was_predicted_has_not_leapt_there) {
  ObjectTrack track;
  track.stamp = track.state.stamp = kStart;
  track.state.mean[3] = 10;  // m/s, known well; its place is not, as something hides it
  track.state.covariance.diagonal() << 1, 1, 1e-4, 0.01, 0.01, 1e-4, 1e-4, 1e-4;
  TrackState out = predicted(track.state, shifted(kStart, kPeriod_s), {});
  out.mean[0] += 0.8;
  out.covariance.topLeftCorner<2, 2>() = 1e-4 * Eigen::Matrix2d::Identity();
  track.ahead = Ahead{track.state, out, 5};
  EXPECT_NEAR(track.expected_at(shifted(kStart, 0.05), {}).step().mean.x(), 0.5, 0.02);
}

TEST(LookAhead, leaves_the_tracks_where_they_are) {
  const ObjectTrack track = SightsOfOne({20, 21, 22}).track_of_first(2);
  EXPECT_EQ(track.stamp, kStart);
  EXPECT_EQ(track.state.velocity(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(track.log_odds, track.latest_log_odds);
}

}  // namespace
}  // namespace lidar_upsampling
