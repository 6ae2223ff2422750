// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "clouds.h"

#include <gtest/gtest.h>

#include "../metrics/clouds.h"
#include "lidar_upsampling/metrics/chamfer.h"

namespace lidar_upsampling {
namespace {

/// Looks along x of the lidar, at the origin.
Camera looking_ahead() {
  Camera camera;
  camera.model = {400, 400, 200, 200, 200, 200};
  camera.T_vehicle_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return camera;
}

Points seen_by(const Camera& camera, const LidarScan& scan, const Points& points) {
  Points seen;
  for (const auto& point : points)
    if (in_view(views_of({camera}, scan), point.cast<double>())) seen.push_back(point);
  return seen;
}

/// A thousand points of which the first hundred are an object's, that `ego` leaves behind.
class Clouds : public ::testing::Test {
 protected:
  Clouds() {
    reference_.points = testing::lidar_like_cloud(900, 1);
    ObjectResult object;
    for (int i = 0; i < 100; ++i) object.object.points.push_back(i);
    result_.objects.push_back(object);
    clouds_[Row::hold] = testing::lidar_like_cloud(800, 2);
    clouds_[Row::ego] = clouds_[Row::oracle] = testing::lidar_like_cloud(1000, 3);
    for (int i = 0; i < 100; ++i) clouds_[Row::oracle][i] += Eigen::Vector3f(3, 1, 0);
  }

  void measure() { measure_clouds(clouds_, reference_, {camera_}, result_); }

  Camera camera_ = looking_ahead();
  LidarScan reference_;
  PerRow<Points> clouds_;
  ScanResult result_;
};

TEST_F(Clouds, rows_that_share_a_scene_get_the_distance_of_their_own_cloud) {
  measure();
  for (const Row row : {Row::hold, Row::ego, Row::oracle}) {
    const Chamfer alone = compute_chamfer(clouds_[row], reference_.points);
    ASSERT_TRUE(result_.clouds[row]);
    EXPECT_NEAR(result_.clouds[row]->full.mean_m(), alone.mean_m(), 1e-6) << name_of(row);
    EXPECT_NEAR(result_.clouds[row]->full.sum_sq_m2(), alone.sum_sq_m2(), 1e-5) << name_of(row);
  }
  EXPECT_NE(result_.clouds[Row::ego]->full.mean_m(), result_.clouds[Row::oracle]->full.mean_m());
}

TEST_F(Clouds, in_view_only_what_is_in_view_counts_on_both_sides) {
  measure();
  const Points truth = seen_by(camera_, reference_, reference_.points);
  ASSERT_GT(truth.size(), 50U);
  ASSERT_LT(truth.size(), 450U);
  for (const Row row : {Row::hold, Row::ego, Row::oracle}) {
    const Chamfer alone = compute_chamfer(seen_by(camera_, reference_, clouds_[row]), truth);
    ASSERT_TRUE(result_.clouds[row] && result_.clouds[row]->in_view);
    EXPECT_NEAR(result_.clouds[row]->in_view->mean_m(), alone.mean_m(), 1e-6) << name_of(row);
    EXPECT_NEAR(result_.clouds[row]->in_view->sum_sq_m2(), alone.sum_sq_m2(), 1e-5) << name_of(row);
  }
}

TEST_F(Clouds, with_nothing_in_view_there_is_a_distance_of_the_whole_alone) {
  for (auto& point : reference_.points) point.x() = -std::abs(point.x()) - 1;
  measure();
  ASSERT_TRUE(result_.clouds[Row::hold] && result_.clouds[Row::ego]);
  EXPECT_FALSE(result_.clouds[Row::hold]->in_view);
  EXPECT_FALSE(result_.clouds[Row::ego]->in_view);
  EXPECT_GT(result_.clouds[Row::ego]->full.mean_m(), 0);
}

TEST_F(Clouds, a_scan_that_is_one_object_is_measured_too) {
  result_.objects[0].object.points.clear();
  for (int i = 0; i < 1000; ++i) result_.objects[0].object.points.push_back(i);
  measure();
  const Chamfer alone = compute_chamfer(clouds_[Row::oracle], reference_.points);
  EXPECT_NEAR(result_.clouds[Row::oracle]->full.mean_m(), alone.mean_m(), 1e-6);
}

}  // namespace
}  // namespace lidar_upsampling
