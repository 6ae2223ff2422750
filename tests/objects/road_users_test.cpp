// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/road_users.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/units.h"
#include "road_user_clusters.h"
#include "street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;
using testing::SeenBox;

constexpr double kGroundBelow_m = 1.2, kHalfView_deg = 28;

// What a depth camera that looks ahead sees of a box on flat ground.
LidarScan depth_scan_of(const BoxObject& box) {
  LidarScan scan;
  const SeenBox seen(box);
  scan.num_rings = 120;
  scan.num_columns = 280;
  for (int ring = 0; ring < scan.num_rings; ++ring)
    for (int column = 0; column < scan.num_columns; ++column) {
      const double azimuth = kHalfView_deg * (1 - 2 * (column + 0.5) / scan.num_columns) * kDegree;
      const double up = (20 - 40. * ring / scan.num_rings) * kDegree;
      const Eigen::Vector3d ray(std::cos(azimuth), std::sin(azimuth), std::tan(up));
      const double to_ground = up < 0 ? -kGroundBelow_m / ray.z() : 1e9;
      const double range = std::min(seen.range_of(ray), to_ground);
      if (range > 14) continue;
      scan.points.emplace_back((range * ray).cast<float>());
      scan.ring.push_back(static_cast<std::uint16_t>(ring));
      scan.column.push_back(static_cast<std::uint16_t>(column));
    }
  return scan;
}

std::size_t num_found(const LidarScan& scan) {
  return testing::road_user_clusters(scan, segment_scan(scan)).size();
}

BoxObject box_at(double x, double y, double length) {
  return {{x, y, -kGroundBelow_m}, length, 1.6, 1.4, 0};
}

TEST(RoadUsers, a_car_in_view_is_an_object) {
  EXPECT_EQ(num_found(depth_scan_of(box_at(7, 0, 4))), 1U);
}

TEST(RoadUsers, what_the_view_cuts_off_may_be_a_car_however_little_is_seen) {
  // The front of a car that comes in from the right: its side ends where the view does.
  const double edge_x = 3.5 / std::tan(kHalfView_deg * kDegree);
  const LidarScan scan = depth_scan_of({{edge_x - 1.8, -4.3, -kGroundBelow_m}, 4, 1.6, 1.4, 0});
  EXPECT_EQ(num_found(scan), 1U);
}

TEST(RoadUsers, as_little_of_a_thing_in_the_midst_of_the_view_is_a_post) {
  EXPECT_EQ(num_found(depth_scan_of({{7, 0, -kGroundBelow_m}, 0.2, 0.2, 1.4, 0})), 0U);
}

TEST(RoadUsers, a_person_is_as_much_wider_than_seen_as_columns_are_apart) {
  const auto upright = [](double height) {
    // Seven columns show 27 cm of it.
    return depth_scan_of({{13, 0.0227F, -kGroundBelow_m}, 0.2, 0.32, height, 0});
  };
  EXPECT_EQ(num_found(upright(1.8)), 1U);
  EXPECT_EQ(num_found(upright(2.5)), 0U) << "a pole";
}

TEST(RoadUsers, are_named_by_size) {
  const auto name = [](float length, float width, float top) {
    return std::string(class_by_size({{}, length, width, 0, top}));
  };
  EXPECT_EQ(name(4, 1.8F, 1.5F), "car");
  EXPECT_EQ(name(0.6F, 0.4F, 1.8F), "person");
  EXPECT_EQ(name(2.5F, 0.2F, 3.4F), "truck");
  EXPECT_EQ(name(0.6F, 0.2F, 3.4F), "pole");
  EXPECT_EQ(name(1, 0.4F, 0.7F), "object");
}

TEST(RoadUsers, what_is_none_has_its_reason) {
  const LidarScan scan = depth_scan_of(box_at(7, 0, 4));
  const SceneSegments segments = segment_scan(scan);
  ClusterDetectorOptions options;
  const auto is_why = [&](const std::string& reason) {
    const auto why = why_no_road_users(scan, segments, options);
    return std::any_of(why.begin(), why.end(),
                       [&](const char* word) { return word != nullptr && word == reason; });
  };
  EXPECT_EQ(num_found(scan), 1U);
  options.max_range = 3;
  EXPECT_TRUE(is_why("too_far"));
  options = {};
  options.max_width = 0.5;
  options.max_length = 1;
  EXPECT_TRUE(is_why("too_long"));
  options = {};
  options.min_points = 100000;
  EXPECT_TRUE(is_why("too_few_points"));
}

}  // namespace
}  // namespace lidar_upsampling
