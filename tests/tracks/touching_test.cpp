// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/touching.h"

#include <gtest/gtest.h>

#include "tracks/car_on_pictures.h"
#include "tracks/objects_scan.h"
#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;
using Points = std::vector<Eigen::Vector3f>;

Points shifted_by(Points points, double x, double y) {
  for (Eigen::Vector3f& point : points) point += Eigen::Vector3d(x, y, 0).cast<float>();
  return points;
}

/// A car from behind, the middle of its rear there.
Points car_at(double x, double y) { return shifted_by(testing::vehicle(0, 4), x, y); }

/// A scan whose clusters hold some things each.
struct StreetScan : testing::ObjectsScan {
  StreetScan(double time_s, const std::vector<std::vector<Points>>& clusters) {
    scan.stamp = shifted(kStart, time_s);
    for (const std::vector<Points>& cluster : clusters) {
      ScanObject object;
      Eigen::AlignedBox3f bounds;
      for (const Points& thing : cluster) {
        for (const Eigen::Vector3f& point : thing) {
          object.points.push_back(static_cast<int>(scan.points.size()));
          scan.points.push_back(point);
          bounds.extend(point);
        }
      }
      object.centroid = mean_of(points_at(scan, object.points));
      object.length = bounds.sizes().head<2>().maxCoeff();
      objects.push_back(object);
    }
  }
};

/// Where a car drives by, 8 m/s, x at a time.
double driven_m(double time_s) { return 12 + 8 * time_s; }

/// What some scans have shown of a car that drives towards another one, both apart.
TrackStore two_cars(double second_speed_m_s) {
  TrackStore store;
  for (int i = 0; i < 8; ++i) {
    const double t = 0.1 * i;
    StreetScan(t, {{car_at(driven_m(t), 0)}, {car_at(20 + second_speed_m_s * t, 2.2)}})
        .take_up(store);
  }
  return store;
}

TEST(Touching, who_drives_by_what_is_parked_stays_a_track_of_its_own) {
  TrackStore store = two_cars(0);
  const Points driven = car_at(driven_m(0.8), 0), parked = car_at(20, 2.2);
  StreetScan merged(0.8, {{driven, parked}});
  const std::vector<int> track_of = merged.take_up(store);
  ASSERT_EQ(track_of.size(), 2U);
  EXPECT_EQ(merged.objects[0].points.size(), driven.size());
  EXPECT_EQ(merged.objects[1].points.size(), parked.size());
  EXPECT_EQ(store.tracks[track_of[0]].id, 0);
  EXPECT_EQ(store.tracks[track_of[1]].id, 1);
  EXPECT_NEAR(store.tracks[track_of[0]].state.velocity().x(), 8, 0.3);
  EXPECT_NEAR(merged.objects[1].centroid.x(), mean_of(parked).x(), 1e-4);
  EXPECT_LT(merged.objects[1].length, 4.5);
}

TEST(Touching, who_goes_the_same_way_stays_one_object) {
  TrackStore store = two_cars(8);
  StreetScan merged(0.8, {{car_at(driven_m(0.8), 0), car_at(20 + 8 * 0.8, 2.2)}});
  EXPECT_EQ(merged.take_up(store).size(), 1U);
}

TEST(Touching, who_is_not_seen_takes_nothing_of_what_stands_before_him) {
  TrackStore store = two_cars(0);
  StreetScan one(0.8, {{car_at(20, 2.2)}});
  const std::vector<int> track_of = one.take_up(store);
  ASSERT_EQ(track_of.size(), 1U);
  EXPECT_EQ(store.tracks[track_of[0]].id, 1);
}

TEST(Touching, what_a_detector_has_parted_is_left_to_it) {
  TrackStore store = two_cars(0);
  StreetScan merged(0.8, {{car_at(driven_m(0.8), 0), car_at(20, 2.2)}});
  merged.objects[0].external_id = 7;
  EXPECT_EQ(merged.take_up(store).size(), 1U);
}

TEST(Touching, parts_of_a_turning_scan_were_seen_at_their_own_instants) {
  TrackStore store = two_cars(0);
  const Points driven = car_at(driven_m(0.8), 0), parked = car_at(20, 2.2);
  StreetScan merged(0.8, {{driven, parked}});
  merged.scan.time_s.assign(driven.size(), 0.01F);
  merged.scan.time_s.resize(driven.size() + parked.size(), -0.01F);
  merged.objects[0].time_s = 0.001;
  ASSERT_EQ(merged.take_up(store).size(), 2U);
  EXPECT_NEAR(merged.objects[0].time_s, 0.01, 1e-6);
  EXPECT_NEAR(merged.objects[1].time_s, -0.01, 1e-6);
}

}  // namespace
}  // namespace lidar_upsampling
