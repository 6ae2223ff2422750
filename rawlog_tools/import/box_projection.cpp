// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/box_projection.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace lidar_upsampling::importing {
namespace {

constexpr double kNearest = 0.1;  // m; where a box is cut off that reaches behind the camera
constexpr double kSmallest = 1;   // pixels

using Polygon = std::vector<Eigen::Vector3d>;

// Face i of the box: at the lower or upper end of axis i / 2.
Polygon face(const Pose& T_camera_object, const Eigen::Vector3d& size, int i) {
  const int axis = i / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
  Polygon corners;
  for (const auto& [a, b] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    Eigen::Vector3d corner;
    corner[axis] = i % 2 == 0 ? -0.5 : 0.5;
    corner[next] = a;
    corner[last] = b;
    corners.emplace_back(T_camera_object * size.cwiseProduct(corner));
  }
  return corners;
}

// The part of a polygon where `normal` * p >= offset (Sutherland and Hodgman, 1974).
Polygon cut_off(const Polygon& polygon, const Eigen::Vector3d& normal, double offset) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = normal.dot(a) - offset, at_b = normal.dot(b) - offset;
    if (at_a >= 0) inside.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) inside.emplace_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return inside;
}

// What the picture shows of it; the picture's borders are planes through the camera.
Polygon seen_part(const CameraModel& model, Polygon polygon) {
  const Eigen::Vector3d u(model.fx, 0, model.cx), v(0, model.fy, model.cy),
      z = Eigen::Vector3d::UnitZ();
  polygon = cut_off(polygon, z, kNearest);
  polygon = cut_off(polygon, u, 0);
  polygon = cut_off(polygon, v, 0);
  polygon = cut_off(polygon, model.width * z - u, 0);
  return cut_off(polygon, model.height * z - v, 0);
}

}  // namespace

std::optional<Box2d> project_box(const CameraModel& model, const Pose& T_camera_object,
                                 const Eigen::Vector3d& size) {
  if (model.distortion_model != DistortionModel::none) {
    throw std::invalid_argument("boxes are projected on pictures without distortion only");
  }
  Box2d box = Box2d::around_nothing();
  for (int i = 0; i < 6; ++i) {
    for (const Eigen::Vector3d& p : seen_part(model, face(T_camera_object, size, i))) {
      const double u = model.fx * p.x() / p.z() + model.cx, v = model.fy * p.y() / p.z() + model.cy;
      box.extend(u, v);
    }
  }
  if (!(box.width() >= kSmallest && box.height() >= kSmallest)) return std::nullopt;
  return box;
}

}  // namespace lidar_upsampling::importing
