// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/hidden_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "tracks/car_on_pictures.h"
#include "tracks/vehicle_surface.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;

constexpr float kSide_m = 8, kStep_m = 1, kLong_m = 4;

using SidePoints = std::vector<Eigen::Vector3f>;

/// The flat side of a car that crosses our way; none of it where something nearer stands.
SidePoints side_of_car(float rear, float shown_from, float shown_to) {
  SidePoints points;
  for (float x = rear; x <= rear + kLong_m; x += 0.1F)
    for (float z = -1.2F; z < 0.3F; z += 0.1F)
      if (x >= shown_from && x <= shown_to) points.emplace_back(x, kSide_m, z);
  return points;
}

/// Walls all around, and something nearer between two places of the car's lane.
SeenSpace street(float hides_from, float hides_to) {
  constexpr double kWall_m = 40, kNear_m = 4;
  return {testing::all_around([&](const Eigen::Vector3d& way) {
            const double at_lane = kSide_m * way.x() / way.y();
            const bool hides = way.y() > 0 && at_lane > hides_from && at_lane < hides_to;
            return hides ? kNear_m / way.y() : kWall_m;
          }),
          0.4};
}

/// Goes by from left to right; something nearer may hide a part of its lane.
class CarThatGoesBy {
 public:
  static constexpr float kEnd = std::numeric_limits<float>::infinity();

  /// @return its track.
  const ObjectTrack& show(float hides_from, float hides_to, float shown_from, float shown_to) {
    const SidePoints points =
        side_of_car(-2 + kStep_m * static_cast<float>(scans_), shown_from, shown_to);
    const auto seen = std::make_shared<const SeenSpace>(street(hides_from, hides_to));
    scan_.stamp = shifted(kStart, 0.1 * scans_++);
    scan_.points = points;
    ScanObject object;
    object.points.resize(points.size());
    std::iota(object.points.begin(), object.points.end(), 0);
    object.centroid = mean_of(points);
    object.length = points.back().x() - points.front().x();
    std::vector<ScanObject> objects{object};
    const int track =
        take_up_scan(store_, objects, {scan_, T_rest_lidar_, exact_, seen}, {}).front();
    return store_.tracks[track];
  }
  const ObjectTrack& show_whole() { return show(kEnd, kEnd, -kEnd, kEnd); }

 private:
  LidarScan scan_;
  Pose T_rest_lidar_ = Pose::Identity();
  Matrix6d exact_ = Matrix6d::Zero();
  TrackStore store_;
  int scans_ = 0;
};

float front_of(const ObjectTrack& track) {
  const SidePoints& points = track.surface->points();
  return std::max_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.x() < b.x(); })
      ->x();
}

TEST(HiddenPart, an_object_does_not_shrink_as_something_hides_it) {
  CarThatGoesBy car;
  for (int i = 0; i < 4; ++i) car.show_whole();
  const ObjectTrack& track = car.show(3, 30, -10, 3);  // of 2 to 6 m
  EXPECT_NEAR(front_of(track), 6, 0.3);
  EXPECT_NEAR(track.length, 1, 0.2) << "of what is seen";
  EXPECT_NEAR(track.whole_length, kLong_m, 0.4);
}

TEST(HiddenPart, it_is_the_same_when_its_other_end_comes_out) {
  CarThatGoesBy car;
  int id = -1;
  for (int i = 0; i < 4; ++i) id = car.show_whole().id;
  EXPECT_EQ(car.show(2.8F, 5.4F, -10, 2.8F).id, id);          // of 2 to 6 m, its rear
  const ObjectTrack& track = car.show(2.8F, 5.4F, 5.4F, 30);  // of 3 to 7 m, its front
  EXPECT_EQ(track.id, id);
  EXPECT_NEAR(track.state.velocity().x(), 10, 1.5);
}

TEST(HiddenPart, what_would_be_seen_and_is_not_is_forgotten) {
  CarThatGoesBy car;
  for (int i = 0; i < 4; ++i) car.show_whole();
  EXPECT_NEAR(front_of(car.show(CarThatGoesBy::kEnd, 0, -10, 4)), 4, 0.3) << "nothing hides it";
}

TEST(HiddenPart, of_what_its_own_front_hides_nothing_is_kept) {
  CarThatGoesBy car;
  for (int i = 0; i < 4; ++i) car.show_whole();
  ObjectTrack track = car.show_whole();
  track.centroid_rest.y() += 1;  // what was seen of it lies behind what is seen now
  SidePoints behind;
  for (Eigen::Vector3f point : track.surface->points())
    behind.emplace_back(1.1F * point.x(), 1.1F * point.y(), 1.1F * point.z());
  track.surface = std::make_shared<const Surface>(behind);
  TrackState now = track.state;
  now.mean.setZero();
  LidarScan scan;
  scan.points = side_of_car(2, -10, 30);
  ScanObject object;
  object.points.resize(scan.points.size());
  std::iota(object.points.begin(), object.points.end(), 0);
  object.centroid = mean_of(scan.points);
  const auto seen = std::make_shared<const SeenSpace>(street(1.9F, 6.1F));  // by itself
  const Pose here = Pose::Identity();
  const Matrix6d exact = Matrix6d::Zero();
  EXPECT_LT(hidden_part(track, now, object, {scan, here, exact, seen}).size(), behind.size() / 20);
}

}  // namespace
}  // namespace lidar_upsampling
