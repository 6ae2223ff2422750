// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// What several cameras tell of a street, and what is in view of one.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "lidar_upsampling/vision/projection.h"
#include "street_objects.h"

namespace lidar_upsampling {
namespace {

TEST(LidarUpsampler, two_cameras_make_one_virtual_scan_per_instant) {
  StreetRun street(
      "[camera.REAR]\nwidth = 621\nheight = 188\nfx = 360\nrate_hz = 30\norientation_deg = 180 0 "
      "0\n"
      "[vehicle.behind]\nx_m = -16\ny_m = -1.7\nspeed_mps = 12\n");
  LidarUpsampler upsampler{moving_points()};
  upsampler.expect_cameras({"CAM0", "REAR"});
  const auto scans = street.run(upsampler);
  ASSERT_EQ(scans.size(), 10U);
  bool seen_behind = false;
  for (const ObjectMotion* object : moving_objects(scans.back()))
    if (object->camera_label == "REAR" && std::abs(object->velocity_lidar_k.x() - 12) < 1.5)
      seen_behind = true;
  EXPECT_TRUE(seen_behind);
}

TEST(LidarUpsampler, images_of_one_instant_make_one_virtual_scan_when_all_are_there) {
  StreetRun street(std::string(kSmallRig) +
                   "[scenario]\nduration_s = 0.2\n[camera.LEFT]\nwidth = 414\nheight = 125\n"
                   "fx = 240\nrate_hz = 30\norientation_deg = 80 0 0\n"
                   "[vehicle.passing]\nx_m = 8\ny_m = 2.6\nyaw_deg = 180\nspeed_mps = 11\n");
  LidarUpsampler upsampler{moving_points()};
  upsampler.expect_cameras({"CAM0", "LEFT"});
  const auto scans = street.run(upsampler);
  ASSERT_EQ(scans.size(), 4U);
  std::set<std::string> cameras;
  for (const VirtualScan& scan : scans)
    for (const ObjectMotion& object : scan.objects) cameras.insert(object.camera_label);
  EXPECT_EQ(cameras.count("CAM0") + cameras.count("LEFT"), 2U);
}

TEST(LidarUpsampler, a_car_stays_one_track_and_in_place_from_one_camera_to_the_next) {
  StreetRun street(
      "[camera.LEFT]\nwidth = 621\nheight = 188\nfx = 360\nrate_hz = 30\norientation_deg = 80 0 "
      "0\n"
      "[vehicle.passing]\nx_m = 14\ny_m = 2.6\nyaw_deg = 180\nspeed_mps = 11\n");
  LidarUpsampler upsampler{moving_points()};
  upsampler.expect_cameras({"CAM0", "LEFT"});
  const int car = car_at_velocity(street, -11);
  std::set<std::string> cameras;
  std::set<int> tracks;
  for (const VirtualScan& scan : street.run(upsampler)) {
    if (scan.key_stamp < shifted(street_begin(), 0.15)) continue;  // two scans show how it moves
    const ObjectMotion* told = motion_of(street, scan, car);
    ASSERT_NE(told, nullptr);
    cameras.insert(told->camera_label);
    tracks.insert(told->track_id);
    const Pose truth = street.true_motion(car, scan.key_stamp, scan.scan.stamp);
    const Eigen::Vector3d& centroid = told->centroid_lidar_k;
    EXPECT_LT((told->T_lidar_t_lidar_k * centroid - truth * centroid).norm(), 0.05);
  }
  EXPECT_EQ(cameras, (std::set<std::string>{"CAM0", "LEFT"}));
  EXPECT_EQ(tracks.size(), 1U);
}

TEST(LidarUpsampler, an_object_is_in_view_as_long_as_a_corner_of_its_box_is) {
  StreetRun street("[vehicle.passing]\nx_m = 11\ny_m = 2.6\nyaw_deg = 180\nspeed_mps = 11\n");
  LidarUpsampler upsampler{moving_points()};
  int by_corner = 0;
  for (const VirtualScan& scan : street.run(upsampler)) {
    const LidarScan& key = street.scan_at(scan.key_stamp).scan;
    const Camera& camera = street.picture_at(0, scan.scan.stamp).camera;
    for (const ObjectMotion& object : scan.objects) {
      const std::vector<Eigen::Vector3f> points = points_at(key, object.points);
      if (points.empty()) continue;
      const Pose T =
          camera.T_vehicle_camera.inverse() * key.T_vehicle_lidar * object.T_lidar_t_lidar_k;
      const auto shows = [&](const Eigen::Vector3f& place) {
        return project(camera.model, T * place.cast<double>()).has_value();
      };
      Eigen::AlignedBox3f box;
      for (const Eigen::Vector3f& point : points) box.extend(point);
      bool corner = false;
      for (int i = 0; i < 8; ++i)
        corner |= shows(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)));
      const bool point = std::any_of(points.begin(), points.end(), shows);
      EXPECT_EQ(object.camera_label, point || corner ? "CAM0" : "");
      by_corner += corner && !point ? 1 : 0;
    }
  }
  EXPECT_GT(by_corner, 0);
}

TEST(LidarUpsampler, two_cameras_that_shutter_by_turns_both_know_of_a_car) {
  StreetRun street(
      "[scenario]\nduration_s = 0.2\n[camera.REAR]\nwidth = 414\nheight = 125\nfx = 240\n"
      "rate_hz = 30\nphase_s = 0.017\norientation_deg = 180 0 0\n");
  LidarUpsampler upsampler{moving_points()};
  upsampler.expect_cameras({"CAM0", "REAR"});
  const int car = car_at_velocity(street, 11);
  const auto behind = sim::stamps_of(30, 0.017, 0.2);
  int num_behind = 0;
  for (const VirtualScan& scan : street.run(upsampler)) {
    if (scan.scan.stamp < shifted(street_begin(), 0.03))
      continue;  // no picture of it has been taken
    num_behind += static_cast<int>(std::count(behind.begin(), behind.end(), scan.scan.stamp));
    const ObjectMotion* told = motion_of(street, scan, car);
    ASSERT_NE(told, nullptr);
    EXPECT_EQ(told->camera_label, "CAM0");
    const Pose truth = street.true_motion(car, scan.key_stamp, scan.scan.stamp);
    const Eigen::Vector3d& centroid = told->centroid_lidar_k;
    EXPECT_LT((told->T_lidar_t_lidar_k * centroid - truth * centroid).norm(), 0.3);
  }
  EXPECT_GE(num_behind, 3);
}

}  // namespace
}  // namespace lidar_upsampling
