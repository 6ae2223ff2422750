// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/object_points.h"

#include <gtest/gtest.h>

#include <set>

#include "road_user_clusters.h"
#include "street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;
using testing::flat;
using testing::forward_camera;
using testing::make_street;
using testing::Street;
using testing::wide_camera;

/// The 2D box of all of an object, hidden or not.
Box2d box_of(const BoxObject& object) {
  Box2d box = Box2d::around_nothing();
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {0., 1.}) {
        const Eigen::Vector3d corner =
            object.center +
            Eigen::AngleAxisd(object.yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::Vector3d(x * object.length, y * object.width, z * object.height);
        const auto pixel = project(wide_camera().model, forward_camera() * corner);
        if (pixel) box.extend(pixel->x(), pixel->y());
      }
    }
  }
  return box;
}

double share_of(const Street& street, const std::vector<int>& points, int object) {
  double hits = 0;
  for (const int point : points) hits += street.truth[point] == object ? 1 : 0;
  return hits / static_cast<double>(points.size());
}

class ObjectPoints : public ::testing::Test {
 protected:
  std::optional<std::vector<int>> select(const Box2d& box, const ObjectPointOptions& options = {}) {
    return select_object_points(street_.scan, visible_, segments_, box, options);
  }
  void set_up(const std::vector<BoxObject>& objects) {
    objects_ = objects;
    street_ = testing::make_street(testing::flat, objects);
    segments_ = segment_scan(street_.scan);
    visible_ = project_scan(wide_camera().model, forward_camera(), street_.scan.points);
  }
  std::vector<BoxObject> objects_;
  Street street_;
  SceneSegments segments_;
  std::vector<ProjectedPoint> visible_;
};

TEST_F(ObjectPoints, of_a_car_alone_are_all_but_its_lowest) {
  set_up({{{12, 1, -1.6}, 4.2, 1.8, 1.4, 0.2}});
  const auto points = select(box_of(objects_[0]));
  ASSERT_TRUE(points);
  EXPECT_EQ(share_of(street_, *points, 0), 1);
  const auto on_car = std::count(street_.truth.begin(), street_.truth.end(), 0);
  EXPECT_GT(static_cast<double>(points->size()), 0.9 * static_cast<double>(on_car));
}

TEST_F(ObjectPoints, of_two_objects_in_one_frustum_belong_to_the_one_that_fills_the_box) {
  // A pedestrian before a van, both in the van's box.
  set_up({{{18, 0, -1.5}, 5, 2.1, 2.2, 1.57}, {{10, 0.3, -1.8}, 0.4, 0.5, 1.5, 0}});
  const auto van = select(box_of(objects_[0]));
  ASSERT_TRUE(van);
  EXPECT_GT(share_of(street_, *van, 0), 0.99);
  const auto pedestrian = select(box_of(objects_[1]));
  ASSERT_TRUE(pedestrian);
  EXPECT_GT(share_of(street_, *pedestrian, 1), 0.99);
}

TEST_F(ObjectPoints, of_a_half_hidden_car_are_not_those_of_the_car_before_it) {
  set_up({{{20, 0.6, -1.6}, 4.2, 1.8, 1.5, 0}, {{12, -0.5, -1.6}, 4.2, 1.8, 1.4, 0}});
  const auto behind = select(box_of(objects_[0]));
  ASSERT_TRUE(behind);
  EXPECT_GT(share_of(street_, *behind, 0), 0.95);
}

TEST_F(ObjectPoints, outside_the_box_come_in_with_the_cluster_if_wanted) {
  set_up({{{12, 1, -1.6}, 4.2, 1.8, 1.4, 0.2}});
  Box2d narrow = box_of(objects_[0]);
  narrow.right -= 0.2 * narrow.width();
  ObjectPointOptions options;
  const auto whole = select(narrow, options);
  options.min_share = 2;  // nothing is common enough
  const auto part = select(narrow, options);
  ASSERT_TRUE(whole);
  ASSERT_TRUE(part);
  EXPECT_GT(whole->size(), part->size());
  for (const int point : *part) {
    const auto at = std::find_if(visible_.begin(), visible_.end(),
                                 [&](const ProjectedPoint& p) { return p.index == point; });
    EXPECT_LE(at->u, narrow.right + 0.05 * narrow.width());
  }
}

TEST_F(ObjectPoints, there_are_none_in_a_box_on_the_empty_road) {
  set_up({{{12, 6, -1.6}, 4.2, 1.8, 1.4, 0}});
  EXPECT_FALSE(select({560, 200, 660, 300}));
}

TEST_F(ObjectPoints, of_road_users_are_clusters_of_cars_and_not_of_walls) {
  set_up({{{12, 1, -1.6}, 4.2, 1.8, 1.4, 0.2},
          {{25, -3, -1.6}, 4.2, 1.8, 1.5, 0},
          {{25, 12, -1.8}, 40, 0.5, 3.5, 0}});
  const auto found = testing::road_user_clusters(street_.scan, segments_);
  std::set<int> objects;
  for (const int cluster : found) {
    const auto& points = segments_.clusters[cluster];
    const int object = street_.truth[points.front()];
    objects.insert(object);
    EXPECT_STREQ(class_by_size(segments_.extents[cluster]), "car");
    EXPECT_EQ(share_of(street_, points, object), 1);
  }
  EXPECT_EQ(objects, (std::set<int>{0, 1}));
}

TEST_F(ObjectPoints, a_car_that_one_ring_of_a_coarse_lidar_shows_low_is_a_candidate) {
  street_ = testing::make_street(testing::flat, {{{24, 0, -1.8}, 4.2, 1.8, 1.4, 0}}, 64);
  const auto seen_low = [&](std::size_t i) {
    const double above = street_.scan.points[i].z() + 1.8;
    return street_.truth[i] == testing::kOnGround || (above > 0.21 && above < 0.32);
  };
  testing::Street coarse;
  for (std::size_t i = 0; i < street_.scan.size(); ++i) {
    if (!seen_low(i)) continue;
    coarse.scan.points.push_back(street_.scan.points[i]);
    coarse.scan.ring.push_back(street_.scan.ring[i]);
    coarse.scan.column.push_back(street_.scan.column[i]);
  }
  coarse.scan.num_rings = 64;
  coarse.scan.num_columns = street_.scan.num_columns;
  SceneSegments segments = segment_scan(coarse.scan, {});
  EXPECT_TRUE(testing::road_user_clusters(coarse.scan, segments).empty());
  segments.vertical_step_deg = 2;
  EXPECT_EQ(testing::road_user_clusters(coarse.scan, segments).size(), 1U);
}

}  // namespace
}  // namespace lidar_upsampling
