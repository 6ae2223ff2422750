// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/objects/column_grid.h"
#include "lidar_upsampling/objects/scene_segments.h"
#include "street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;
using testing::flat;
using testing::make_street;
using testing::Street;

std::vector<int> all_of(const std::vector<Eigen::Vector3f>& points) {
  std::vector<int> indices(points.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<int>(i);
  return indices;
}

/// A lattice of points filling a block.
void add_block(std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& corner,
               const Eigen::Vector3f& size, float step = 0.1F) {
  const Eigen::Vector3i count = (size / step).array().round().cast<int>() + 1;
  for (int i = 0; i < count.prod(); ++i) {
    const Eigen::Vector3i cell(i % count.x(), i / count.x() % count.y(), i / count.x() / count.y());
    points.emplace_back(corner + step * cell.cast<float>());
  }
}

TEST(Clusters, blocks_apart_are_separate_and_the_largest_comes_first) {
  std::vector<Eigen::Vector3f> points;
  add_block(points, {5, 0, 0}, {1, 1, 1});
  const std::size_t first = points.size();
  add_block(points, {5, 2.2F, 0}, {2, 1, 1});
  const auto clusters = euclidean_clusters(points, all_of(points), {});
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].size(), points.size() - first);
  EXPECT_EQ(clusters[0].front(), static_cast<int>(first));
  EXPECT_EQ(clusters[1].size(), first);
}

TEST(Clusters, blocks_that_touch_are_one) {
  std::vector<Eigen::Vector3f> points;
  add_block(points, {5, 0, 0}, {1, 1, 1});
  add_block(points, {5, 1.2F, 0}, {1, 1, 1});
  EXPECT_EQ(euclidean_clusters(points, all_of(points), {}).size(), 1U);
}

TEST(Clusters, a_queue_of_cars_longer_than_a_car_is_split) {
  std::vector<Eigen::Vector3f> points;
  add_block(points, {5, 3, 0}, {4, 1.7F, 1.4F});
  add_block(points, {9.45F, 3, 0}, {4, 1.7F, 1.4F});
  ClusterOptions options;
  EXPECT_EQ(euclidean_clusters(points, all_of(points), options).size(), 2U);
  options.max_splits = 0;
  EXPECT_EQ(euclidean_clusters(points, all_of(points), options).size(), 1U);
}

TEST(Clusters, a_truck_and_its_trailer_are_one) {
  std::vector<Eigen::Vector3f> points;
  add_block(points, {5, 5, 0}, {6, 2.5F, 3.5F});
  add_block(points, {11.45F, 5, 0}, {10, 2.5F, 3.5F});
  EXPECT_EQ(euclidean_clusters(points, all_of(points), {}).size(), 1U);
}

TEST(Clusters, farther_points_may_lie_farther_apart) {
  const auto count_at = [](float range) {
    const std::vector<Eigen::Vector3f> pair{{range, 0, 0}, {range, 0.8F, 0}};
    ClusterOptions options;
    options.min_points = 1;
    return euclidean_clusters(pair, {0, 1}, options).size();
  };
  EXPECT_EQ(count_at(5), 2U);
  EXPECT_EQ(count_at(50), 1U);
}

TEST(Clusters, rings_far_apart_are_bridged_upwards_but_not_sideways) {
  ClusterOptions options;
  options.min_points = 1;
  options.vertical_step_deg = 2;
  const std::vector<Eigen::Vector3f> upright{{20, 0, 0}, {20, 0, 1}};
  const std::vector<Eigen::Vector3f> sideways{{20, 0, 0}, {20, 1, 0}};
  EXPECT_EQ(euclidean_clusters(upright, {0, 1}, options).size(), 1U);
  EXPECT_EQ(euclidean_clusters(sideways, {0, 1}, options).size(), 2U);
}

TEST(Clusters, are_the_components_that_comparing_all_pairs_gives) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> place(-6, 6);
  std::vector<Eigen::Vector3f> points(400);
  for (Eigen::Vector3f& point : points) point = {20 + place(generator), place(generator), 0};
  ClusterOptions options;
  options.voxel_size = 1e-3;
  options.max_splits = 0;
  options.min_points = 1;
  options.distance_per_range = 0;
  options.horizontal_step_deg = options.vertical_step_deg = 0.1;

  std::vector<int> label = all_of(points);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (label[j] <= label[i] || (points[i] - points[j]).norm() > options.min_distance) continue;
        label[j] = label[i];
        changed = true;
      }
    }
  }
  std::map<int, std::vector<int>> expected;
  for (std::size_t i = 0; i < points.size(); ++i) expected[label[i]].push_back(static_cast<int>(i));

  const auto clusters = euclidean_clusters(points, all_of(points), options);
  EXPECT_GT(clusters.size(), 5U);
  EXPECT_EQ(clusters.size(), expected.size());
  for (const auto& cluster : clusters) EXPECT_EQ(cluster, expected[label[cluster.front()]]);
}

TEST(Clusters, no_points_make_none_and_a_negative_distance_is_refused) {
  EXPECT_TRUE(euclidean_clusters({}, {}, {}).empty());
  ClusterOptions options;
  options.min_distance = -1;
  EXPECT_THROW(static_cast<void>(euclidean_clusters({}, {}, options)), std::invalid_argument);
}

TEST(ClusterExtent, measures_a_turned_box) {
  std::vector<Eigen::Vector3f> points;
  add_block(points, {-2, -0.9F, 0.3F}, {4, 1.8F, 1.2F});
  const Eigen::AngleAxisf turn(0.5F, Eigen::Vector3f::UnitZ());
  for (Eigen::Vector3f& point : points) point = turn * point + Eigen::Vector3f(10, 5, 0);
  const ClusterExtent extent = cluster_extent(points, {}, all_of(points));
  EXPECT_NEAR(extent.length, 4, 0.1);
  EXPECT_NEAR(extent.width, 1.8, 0.1);
  EXPECT_NEAR(extent.height(), 1.2, 0.11);
  EXPECT_NEAR(extent.bottom, 0.3, 1e-5);
}

TEST(BeamStep, is_read_from_rings_or_from_elevations) {
  Street street = make_street(flat, {}, 16);
  const double expected = 26.8 / 15;
  const double from_rings = estimate_vertical_step_deg(street.scan);
  EXPECT_NEAR(from_rings, expected, 0.05);
  street.scan.ring.clear();
  street.scan.num_rings = 0;
  EXPECT_NEAR(estimate_vertical_step_deg(street.scan), expected, 0.15);
}

TEST(SegmentScan, finds_each_car_once) {
  const std::vector<BoxObject> cars{{{9, 3, -1.6}, 4.2, 1.8, 1.4, 0.1},
                                    {{16, 2.6, -1.6}, 4.4, 1.8, 1.5, 0},
                                    {{12, -3, -1.6}, 4.2, 1.8, 1.4, 0},
                                    {{25, -4, -1.6}, 4.2, 1.8, 1.5, 0.5}};
  for (const int rings : {64, 16}) {
    const Street street = make_street(flat, cars, rings, 2000);
    const SceneSegments segments = segment_scan(street.scan);
    std::map<int, int> clusters_of_car;
    for (const auto& cluster : segments.clusters) {
      std::map<int, int> points_of;
      for (const int point : cluster) ++points_of[street.truth[point]];
      const auto car = std::max_element(
          points_of.begin(), points_of.end(),
          [](const auto& one, const auto& other) { return one.second < other.second; });
      // Where rings are far apart, one that just misses it may be taken for its lowest.
      EXPECT_GT(car->second, 0.95 * static_cast<double>(cluster.size())) << rings;
      ++clusters_of_car[car->first];
    }
    EXPECT_EQ(clusters_of_car.size(), cars.size()) << rings;
    for (const auto& [car, count] : clusters_of_car) EXPECT_EQ(count, 1) << "car " << car;
  }
}

TEST(ColumnGrid, finds_all_that_lie_nearer_and_their_distances) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-3, 3);
  std::vector<Eigen::Vector3f> points(500);
  for (Eigen::Vector3f& point : points) point = {place(random), place(random), place(random)};
  const ColumnGrid grid(points, 0.5F);
  for (const float reach : {0.3F, 0.5F, 1.7F}) {
    for (int at = 0; at < static_cast<int>(points.size()); ++at) {
      const Eigen::Vector3f& query = points[grid.point[at]];
      std::map<int, float> found, expected;
      grid.for_each_within(at, reach * reach, [&](int point, float sq_distance) {
        EXPECT_TRUE(found.emplace(point, sq_distance).second);
      });
      for (int i = 0; i < static_cast<int>(points.size()); ++i)
        if (const float sq_distance = (points[i] - query).squaredNorm();
            sq_distance < reach * reach)
          expected[i] = sq_distance;
      ASSERT_EQ(found.size(), expected.size());
      for (const auto& [point, sq_distance] : expected)
        EXPECT_NEAR(found.at(point), sq_distance, 1e-5);
    }
  }
}

}  // namespace
}  // namespace lidar_upsampling
