// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/level_slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;

// A ring meets its roof two metres behind its rear, the next one below the upper edge of that.
const BoxObject kCar{{10.3, 0, -1.8}, 4.2, 1.8, 1.55, 0};

/// Clusters of a street, by the box on which points lie that are no ground.
struct Clusters {
  explicit Clusters(const std::vector<BoxObject>& boxes)
      : street(testing::make_street(testing::flat, boxes)), segments(segment_scan(street.scan)) {}

  [[nodiscard]] std::set<int> of_box(int box) const {
    std::set<int> found;
    for (std::size_t i = 0; i < street.truth.size(); ++i)
      if (street.truth[i] == box && street.scan.points[i].z() > -1)
        found.insert(segments.cluster_of[i]);
    return found;
  }

  testing::Street street;
  SceneSegments segments;
};

TEST(LevelSlices, what_one_ring_shows_of_a_roof_belongs_to_the_car_before_it) {
  const Clusters clusters({kCar});
  const auto far = std::count_if(
      clusters.street.scan.points.begin(), clusters.street.scan.points.end(),
      [](const Eigen::Vector3f& p) { return p.x() > 9.5F && p.x() < 12.5F && p.z() > -0.4F; });
  ASSERT_GT(far, 10) << "the roof";
  EXPECT_EQ(clusters.of_box(0).size(), 1U);
}

TEST(LevelSlices, points_and_extents_are_those_of_the_clusters) {
  const Clusters clusters({kCar, {{20, 6, -1.8}, 4, 1.8, 1.5, 0}});
  const SceneSegments& segments = clusters.segments;
  ASSERT_EQ(segments.extents.size(), segments.clusters.size());
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    EXPECT_TRUE(std::is_sorted(segments.clusters[i].begin(), segments.clusters[i].end()));
    for (const int point : segments.clusters[i])
      EXPECT_EQ(segments.cluster_of[point], static_cast<int>(i));
    const ClusterExtent extent =
        cluster_extent(clusters.street.scan.points, segments.ground.height, segments.clusters[i]);
    EXPECT_EQ(extent.length, segments.extents[i].length);
  }
}

TEST(LevelSlices, what_lies_farther_behind_than_a_roof_is_long_is_something_else) {
  const Clusters clusters({{{8.4, 0, -1.8}, 0.4, 1.8, 1.55, 0}, {{15, 0, -0.27}, 2, 1.8, 0.02, 0}});
  ASSERT_EQ(clusters.of_box(1).size(), 1U);
  EXPECT_NE(clusters.of_box(0), clusters.of_box(1));
}

TEST(LevelSlices, what_one_ring_alone_shows_far_away_is_none_as_it_may_stand_upright) {
  const Clusters clusters({{{57, 0, -1.8}, 0.4, 1.8, 1.2, 0}, {{60, 0, -1.8}, 0.4, 1.8, 1.8, 0}});
  const LidarScan& scan = clusters.street.scan;
  SceneSegments segments = clusters.segments;
  ASSERT_EQ(clusters.of_box(0).size(), 1U);
  ASSERT_EQ(clusters.of_box(1).size(), 1U);
  ASSERT_NE(clusters.of_box(0), clusters.of_box(1));
  const int far = *clusters.of_box(1).begin();
  std::vector<int>& of_far = segments.clusters[far];
  const auto highest = *std::max_element(of_far.begin(), of_far.end(), [&](int a, int b) {
    return scan.points[a].z() < scan.points[b].z();
  });
  of_far.erase(std::remove_if(of_far.begin(), of_far.end(),
                              [&](int i) { return scan.ring[i] != scan.ring[highest]; }),
               of_far.end());
  ASSERT_GT(of_far.size(), 4U);
  segments.extents[far] = cluster_extent(scan.points, segments.ground.height, of_far);
  const std::size_t before = segments.clusters.size();
  join_level_slices(scan, segments);
  EXPECT_EQ(segments.clusters.size(), before);
}

}  // namespace
}  // namespace lidar_upsampling
