// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/projection.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

#include "lidar_upsampling/vision/distortion.h"

namespace lidar_upsampling {
namespace {

CameraModel pinhole() { return {1242, 375, 720, 722, 610, 173, DistortionModel::none, {}}; }

CameraModel plumb_bob() {
  return {1392,
          512,
          984,
          981,
          690,
          233,
          DistortionModel::plumb_bob,
          {-0.3728, 0.2037, 2.2e-3, 1.4e-3, -0.0723}};
}

CameraModel rational() {
  return {1280,
          720,
          608,
          607,
          637,
          366,
          DistortionModel::plumb_bob,
          {0.5, -2.6, 8e-4, -3e-4, 1.5, 0.38, -2.4, 1.4}};
}

CameraModel fisheye() {
  return {1280,
          800,
          520,
          520,
          640,
          400,
          DistortionModel::kannala_brandt,
          {-0.02, 0.011, 0, 0, -0.008, 0.0015}};
}

class Lens : public testing::TestWithParam<CameraModel> {};

INSTANTIATE_TEST_SUITE_P(Models, Lens,
                         testing::Values(pinhole(), plumb_bob(), rational(), fisheye()));

TEST_P(Lens, undistorting_a_pixel_inverts_projecting_it) {
  const CameraModel model = GetParam();
  int num_seen = 0;
  int num_pixels = 0;
  for (int v = 0; v < model.height; v += 31) {
    for (int u = 0; u < model.width; u += 31) {
      const Eigen::Vector2d pixel(u, v);
      ++num_pixels;
      const auto ray = undistort(model, pixel);
      if (!ray) continue;
      const auto back = project(model, 7.5 * ray->homogeneous(), -0.5);
      ASSERT_TRUE(back) << pixel.transpose();
      EXPECT_LT((*back - pixel).norm(), 1e-7) << pixel.transpose();
      ++num_seen;
    }
  }
  EXPECT_GT(num_seen, 0.9 * num_pixels);
}

TEST_P(Lens, projects_as_opencv_does) {
  const CameraModel model = GetParam();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> side(-8, 8);
  std::uniform_real_distribution<double> depth(8, 30);
  std::vector<cv::Point3d> points;
  points.reserve(500);
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(side(generator), 0.5 * side(generator), depth(generator));
  }
  const cv::Matx33d matrix(model.fx, 0, model.cx, 0, model.fy, model.cy, 0, 0, 1);
  const auto& k = model.distortion;
  const cv::Vec3d zero(0, 0, 0);
  std::vector<cv::Point2d> expected;
  if (model.distortion_model == DistortionModel::kannala_brandt) {
    cv::fisheye::projectPoints(points, expected, zero, zero, matrix,
                               cv::Vec4d(k[0], k[1], k[4], k[5]));
  } else {
    cv::projectPoints(points, zero, zero, matrix, std::vector<double>(k.begin(), k.end()),
                      expected);
  }
  int num_seen = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = project(model, {points[i].x, points[i].y, points[i].z});
    if (!pixel) continue;
    EXPECT_NEAR(pixel->x(), expected[i].x, 1e-6);
    EXPECT_NEAR(pixel->y(), expected[i].y, 1e-6);
    ++num_seen;
  }
  EXPECT_GT(num_seen, 250);
}

TEST_P(Lens, the_jacobian_agrees_with_differences) {
  const CameraModel model = GetParam();
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(0.1, -0.2), Eigen::Vector2d(-0.4, 0.05), Eigen::Vector2d(0, 0)}) {
    const Eigen::Matrix2d jacobian = distort(model, at).jacobian;
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d difference =
          (distort(model, at + step).point - distort(model, at - step).point) / (2 * kStep);
      EXPECT_LT((difference - jacobian.col(axis)).norm(), 1e-7) << at.transpose();
    }
  }
}

TEST_P(Lens, nothing_far_outside_the_view_lands_in_the_picture) {
  const CameraModel model = GetParam();
  // What the picture's outermost pixels see bounds what anything inside it may see.
  double widest = 0;
  for (int u = -1; u <= model.width; u += 10) {
    for (const int v : {-1, model.height}) {
      const auto ray = undistort(model, Eigen::Vector2d(u, v));
      if (ray) widest = std::max(widest, ray->norm());
    }
  }
  ASSERT_GT(widest, 0);
  for (int ring = 0; ring < 120; ++ring) {
    const double radius = 1.2 * widest * std::pow(1.05, ring);
    for (int direction = 0; direction < 64; ++direction) {
      const double angle = M_PI * direction / 32;
      const Eigen::Vector3d point(radius * std::cos(angle), radius * std::sin(angle), 1);
      EXPECT_FALSE(project(model, point)) << point.transpose();
    }
  }
}

TEST(Projection, a_folding_polynomial_has_a_valid_radius_where_it_turns) {
  CameraModel model = plumb_bob();
  model.distortion = {-0.3, 0, 0, 0, 0};
  // r (1 - 0.3 r^2) turns where 1 = 0.9 r^2.
  EXPECT_NEAR(valid_radius(model), std::sqrt(1 / 0.9), 1e-6);
  EXPECT_EQ(valid_radius(pinhole()), std::numeric_limits<double>::infinity());
}

TEST(Projection, a_point_behind_the_camera_is_not_seen) {
  for (const CameraModel& model : {pinhole(), plumb_bob(), fisheye()}) {
    EXPECT_TRUE(project(model, {0, 0, 5}));
    EXPECT_FALSE(project(model, {0, 0, -5}));
    EXPECT_FALSE(project(model, {0.1, 0.1, 0}));
  }
}

TEST(Projection, a_point_on_the_axis_falls_on_the_principal_point) {
  EXPECT_EQ(*project(pinhole(), {0, 0, 5}), Eigen::Vector2d(610, 173));
}

TEST(Projection, the_margin_is_kept_from_the_outermost_pixel_centres) {
  const CameraModel model = pinhole();
  const auto at = [&](double u, double v) -> Eigen::Vector3d {
    return {(u - model.cx) / model.fx, (v - model.cy) / model.fy, 1};
  };
  EXPECT_TRUE(project(model, at(1240.9, 100)));
  EXPECT_FALSE(project(model, at(1241.1, 100)));
  EXPECT_FALSE(project(model, at(-0.1, 100)));
  EXPECT_TRUE(project(model, at(-0.1, 100), -1));
  EXPECT_FALSE(project(model, at(100, 6.9), 7));
  EXPECT_TRUE(project(model, at(100, 7.1), 7));
  EXPECT_FALSE(project(model, at(100, 367.1), 7));
}

TEST(ProjectScan, agrees_with_projecting_one_by_one_in_the_scans_order) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> side(-50, 50);
  std::vector<Eigen::Vector3f> points;
  points.reserve(30000);
  for (int i = 0; i < 30000; ++i) {
    points.emplace_back(side(generator), side(generator), 0.1F * side(generator));
  }
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T_camera_lidar.translation() << 0.06, -0.08, -0.27;
  const auto projected = project_scan(plumb_bob(), T_camera_lidar, points);
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = T_camera_lidar * points[i].cast<double>();
    const auto pixel = project(plumb_bob(), point);
    if (!pixel) continue;
    ASSERT_LT(next, projected.size());
    EXPECT_EQ(projected[next].index, static_cast<int>(i));
    EXPECT_FLOAT_EQ(projected[next].u, static_cast<float>(pixel->x()));
    EXPECT_FLOAT_EQ(projected[next].v, static_cast<float>(pixel->y()));
    EXPECT_FLOAT_EQ(projected[next].depth, static_cast<float>(point.z()));
    ++next;
  }
  EXPECT_EQ(next, projected.size());
  EXPECT_GT(next, 2000U);
}

TEST(ProjectScan, a_camera_without_calibration_is_refused) {
  CameraModel model = pinhole();
  model.fx = 0;
  EXPECT_THROW((void)project_scan(model, Pose::Identity(), {}), std::invalid_argument);
  model = pinhole();
  model.width = 0;
  EXPECT_THROW((void)project_scan(model, Pose::Identity(), {}), std::invalid_argument);
  model = pinhole();
  model.distortion[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)project_scan(model, Pose::Identity(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
