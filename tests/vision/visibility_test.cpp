// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

CameraModel camera() { return {1242, 375, 720, 720, 610, 173, DistortionModel::none, {}}; }

/// A car-sized box front at `depth` before a wall at 30 m, over flat ground, in the camera frame
/// (+Y down).
struct Scene {
  double box_depth = 10;
  double box_half_width = 0.9;

  /// Where a ray from `origin` ends, and on what.
  enum class Surface { none, ground, box, wall };
  struct Hit {
    Surface surface = Surface::none;
    double range = 1e9;
  };
  [[nodiscard]] Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
    Hit hit;
    const auto consider = [&](double range, Surface surface) {
      if (range > 1e-6 && range < hit.range) hit = {surface, range};
    };
    const double to_box = (box_depth - origin.z()) / ray.z();
    const Eigen::Vector3d on_box = origin + to_box * ray;
    if (std::abs(on_box.x()) < box_half_width && on_box.y() > 0.2 && on_box.y() < 1.7)
      consider(to_box, Surface::box);
    consider((30 - origin.z()) / ray.z(), Surface::wall);
    if (ray.y() > 0) consider((1.7 - origin.y()) / ray.y(), Surface::ground);
    return hit;
  }
};

struct View {
  std::vector<ProjectedPoint> points;
  std::vector<Scene::Surface> surface;  ///< of each
  std::vector<bool> hidden;             ///< from the camera, by ray casting
};

/// A scanner of 64 rings beside and above the camera looks at the scene.
View view_of(const Scene& scene, const Eigen::Vector3d& lidar) {
  std::vector<Eigen::Vector3f> points;
  std::vector<Scene::Surface> surfaces;
  for (int ring = 0; ring < 64; ++ring) {
    const double elevation = (2 - 26.8 * ring / 63) * M_PI / 180;
    for (int column = -230; column <= 230; ++column) {
      const double azimuth = 0.18 * column * M_PI / 180;
      const Eigen::Vector3d ray(std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                                std::cos(elevation) * std::cos(azimuth));
      const auto hit = scene.cast(lidar, ray);
      if (hit.surface == Scene::Surface::none) continue;
      points.emplace_back((lidar + hit.range * ray).cast<float>());
      surfaces.push_back(hit.surface);
    }
  }
  View view;
  view.points = project_scan(camera(), Pose::Identity(), points);
  for (const auto& projected : view.points) {
    const auto index = static_cast<std::size_t>(projected.index);
    const Eigen::Vector3d point = points[index].cast<double>();
    view.surface.push_back(surfaces[index]);
    view.hidden.push_back(scene.cast(Eigen::Vector3d::Zero(), point).range < 1 - 1e-4);
  }
  return view;
}

TEST(Occlusion, points_the_camera_cannot_see_are_flagged_and_others_are_not) {
  const View view = view_of(Scene{}, {0.4, -0.5, -0.3});
  const auto flagged = mark_occluded(view.points);
  ASSERT_EQ(flagged.size(), view.points.size());
  int num_hidden = 0;
  int num_found = 0;
  int num_false = 0;
  for (std::size_t i = 0; i < flagged.size(); ++i) {
    num_hidden += view.hidden[i] ? 1 : 0;
    num_found += view.hidden[i] && flagged[i] ? 1 : 0;
    num_false += !view.hidden[i] && flagged[i] ? 1 : 0;
  }
  EXPECT_GT(num_hidden, 100);
  EXPECT_GT(num_found, 0.85 * num_hidden);
  EXPECT_LT(num_false, 0.002 * static_cast<double>(flagged.size()));
}

TEST(Occlusion, open_ground_and_a_scanner_at_the_cameras_place_give_no_flags) {
  const View view = view_of(Scene{1e6, 0.9}, Eigen::Vector3d::Zero());
  ASSERT_GT(view.points.size(), 5000U);
  const auto flagged = mark_occluded(view.points);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), 1), 0);
}

TEST(Occlusion, a_point_amid_nearer_ones_is_hidden_unless_the_margin_says_no) {
  std::vector<ProjectedPoint> points;
  points.reserve(26);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      points.push_back({5 * row + column, 100 + 2 * static_cast<float>(column),
                        100 + 3 * static_cast<float>(row), 10.F});
    }
  }
  points.push_back({25, 104.5F, 106.5F, 12.F});
  auto flagged = mark_occluded(points);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), 1), 1);
  EXPECT_EQ(flagged.back(), 1);
  points.back().depth = 10.2F;
  flagged = mark_occluded(points);
  EXPECT_EQ(flagged.back(), 0);
}

TEST(DepthEdges, silhouettes_are_flagged_on_both_sides_and_surfaces_are_not) {
  const Scene scene;
  const View view = view_of(scene, Eigen::Vector3d::Zero());
  const auto flagged = mark_depth_edges(view.points);
  const CameraModel model = camera();
  const double left = model.cx - model.fx * scene.box_half_width / scene.box_depth;
  const double top = model.cy + model.fy * 0.2 / scene.box_depth;
  const double bottom = model.cy + model.fy * 1.7 / scene.box_depth;
  int num_near_edge[2] = {0, 0};
  int num_found[2] = {0, 0};
  for (std::size_t i = 0; i < flagged.size(); ++i) {
    const auto& point = view.points[i];
    // Beside the left edge, well above the ground, which meets the box there.
    if (point.v > top + 8 && point.v < bottom - 30 && std::abs(point.u - left) < 2) {
      const int side = view.surface[i] == Scene::Surface::box ? 1 : 0;
      ++num_near_edge[side];
      num_found[side] += flagged[i];
    }
    const bool inside_box = point.u > left + 5 && point.u < 2 * model.cx - left - 5 &&
                            point.v > top + 8 && point.v < bottom - 8;
    if (inside_box) {
      EXPECT_EQ(flagged[i], 0) << point.u << " " << point.v;
    }
    // Ground at a grazing angle is a plane like any other.
    if (view.surface[i] == Scene::Surface::ground && point.v > bottom + 10) {
      EXPECT_EQ(flagged[i], 0) << point.u << " " << point.v;
    }
  }
  for (const int side : {0, 1}) {
    EXPECT_GT(num_near_edge[side], 5);
    EXPECT_GE(num_found[side], 0.95 * num_near_edge[side]);
  }
}

TEST(DepthEdges, no_points_are_no_edges) { EXPECT_TRUE(mark_depth_edges({}).empty()); }

TEST(Visibility, both_at_once_are_what_each_is_alone) {
  const View view = view_of(Scene{}, {0.4, -0.5, -0.3});
  const Visibility both = mark_visibility(view.points);
  EXPECT_EQ(both.hidden, mark_occluded(view.points));
  EXPECT_EQ(both.on_edge, mark_depth_edges(view.points));
}

TEST(Visibility, a_neighbourhood_of_no_size_is_refused) {
  EXPECT_THROW((void)mark_occluded({}, {0, 7}), std::invalid_argument);
  EXPECT_THROW((void)mark_depth_edges({}, {4, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
