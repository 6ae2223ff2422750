// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/msac_plane.h"

#include <gtest/gtest.h>

#include <random>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

struct Scene {
  std::vector<Eigen::Vector3f> points;
  Plane truth;
};

/// A sloping ground of 2 cm noise, and clutter above it.
Scene ground_with_clutter(int num_points, double clutter, double slope_deg = 4) {
  Scene scene;
  scene.truth.normal =
      Eigen::Vector3d(std::sin(slope_deg * kDegree), 0, std::cos(slope_deg * kDegree));
  scene.truth.d = 1.7;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> across(-40, 40);
  std::uniform_real_distribution<double> height(0.3, 5);
  std::normal_distribution<double> noise(0, 0.02);
  for (int i = 0; i < num_points; ++i) {
    const double above = i < clutter * num_points ? height(generator) : noise(generator);
    const double x = across(generator);
    const double y = across(generator);
    const Eigen::Vector3d& n = scene.truth.normal;
    const double z = (above - scene.truth.d - n.x() * x - n.y() * y) / n.z();
    scene.points.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  }
  return scene;
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::min(1., a.dot(b))) / kDegree;
}

TEST(MsacPlane, finds_the_ground_among_forty_percent_clutter) {
  const Scene scene = ground_with_clutter(20000, 0.4);
  const auto fit = estimate_plane(scene.points);
  ASSERT_TRUE(fit);
  EXPECT_LT(angle_deg(fit->normal, scene.truth.normal), 0.02);
  EXPECT_NEAR(fit->d, scene.truth.d, 0.002);
  EXPECT_NEAR(fit->normal.norm(), 1, 1e-12);
}

TEST(MsacPlane, noise_free_points_give_the_exact_plane) {
  std::vector<Eigen::Vector3f> points;
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 10; ++y) points.emplace_back(x, y, -2);
  }
  const auto fit = estimate_plane(points);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->normal - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(fit->d, 2, 1e-9);
}

TEST(MsacPlane, a_wall_is_no_ground_however_many_points_it_has) {
  Scene scene = ground_with_clutter(1000, 0);
  for (int row = 0; row < 25; ++row) {
    for (int column = 0; column < 100; ++column) {
      scene.points.emplace_back(10.F, 0.01F * static_cast<float>(column),
                                0.2F * static_cast<float>(row));
    }
  }
  const auto fit = estimate_plane(scene.points);
  ASSERT_TRUE(fit);
  EXPECT_LT(angle_deg(fit->normal, scene.truth.normal), 0.3);
}

TEST(MsacPlane, a_slope_beyond_max_tilt_is_not_found) {
  const Scene scene = ground_with_clutter(2000, 0, 30);
  PlaneOptions options;
  options.inlier_distance_m = 0.05;
  options.min_inliers = 500;
  EXPECT_FALSE(estimate_plane(scene.points, options));
  options.max_tilt_deg = 40;
  EXPECT_TRUE(estimate_plane(scene.points, options));
}

TEST(MsacPlane, the_normal_points_to_the_up_axis_given) {
  const Scene scene = ground_with_clutter(2000, 0.2);
  PlaneOptions options;
  options.up = -2 * Eigen::Vector3d::UnitZ();
  const auto fit = estimate_plane(scene.points, options);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->normal.z(), 0);
  EXPECT_NEAR(fit->d, -scene.truth.d, 0.01);
}

TEST(MsacPlane, the_same_seed_gives_the_same_plane) {
  const Scene scene = ground_with_clutter(20000, 0.4);
  const auto first = estimate_plane(scene.points);
  const auto second = estimate_plane(scene.points);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->normal, second->normal);
  EXPECT_EQ(first->d, second->d);
}

TEST(MsacPlane, too_few_points_give_none) {
  EXPECT_FALSE(estimate_plane({}));
  EXPECT_FALSE(estimate_plane({{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(estimate_plane({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(MsacPlane, wrong_input_is_refused) {
  const Scene scene = ground_with_clutter(100, 0);
  PlaneOptions options;
  options.inlier_distance_m = 0;
  EXPECT_THROW((void)estimate_plane(scene.points, options), std::invalid_argument);
  options = {};
  options.max_tilt_deg = 0;
  EXPECT_THROW((void)estimate_plane(scene.points, options), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
