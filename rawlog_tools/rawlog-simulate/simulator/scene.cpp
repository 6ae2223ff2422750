// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/scene.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling::sim {

namespace {

PlacedPart place(const Part& part, const Pose& T_world_object) {
  const Eigen::Matrix3d R = T_world_object.linear();
  PlacedPart placed;
  for (const Plane& plane : part.solid.planes) {
    placed.planes.push_back(plane_through(
        T_world_object * Eigen::Vector3d(plane.offset * plane.normal), R * plane.normal));
  }
  for (const Eigen::Vector3d& v : part.solid.vertices)
    placed.vertices.push_back(T_world_object * v);
  placed.center = T_world_object * part.solid.center;
  placed.radius = part.solid.bounding_radius;
  if (part.solid.planes.empty()) {
    placed.to_unit_ball = part.solid.radii.cwiseInverse().asDiagonal() * R.transpose();
  }
  return placed;
}

bool outside(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& side) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](const Eigen::Vector3d& v) { return side.dot(v) > 0; });
}

}  // namespace

Scene scene_at(const World& world, double t,
               const std::function<bool(const Object&, const Pose&)>& matters) {
  Scene scene;
  scene.t = t;
  for (const Object& object : world.objects) {
    const Pose T_world_object = world.T_world_object(object.id, t);
    scene.T_world_object.push_back(T_world_object);
    if (matters && !matters(object, T_world_object)) continue;
    for (std::size_t i = 0; i < object.parts.size(); ++i) {
      scene.parts.push_back(place(object.parts[i], T_world_object));
      scene.parts.back().object = object.id;
      scene.parts.back().part = static_cast<int>(i);
    }
  }
  return scene;
}

View::View(const Scene& scene, const Eigen::Vector3d& origin) {
  for (const PlacedPart& placed : scene.parts) {
    SeenPart part{};
    part.object = placed.object;
    part.part = placed.part;
    for (const Plane& plane : placed.planes) {
      part.faces.push_back({plane.normal, plane.normal.dot(origin) - plane.offset});
    }
    for (const Eigen::Vector3d& v : placed.vertices) part.vertices.emplace_back(v - origin);
    const Eigen::Vector3d to_center = placed.center - origin;
    const double distance = to_center.norm();
    part.center_direction = to_center / distance;
    part.nearest = std::max(0., distance - placed.radius);
    part.angular_radius = distance > placed.radius ? std::asin(placed.radius / distance) : M_PI;
    part.cos_radius = std::cos(part.angular_radius);
    part.sin_radius = std::sin(part.angular_radius);
    if (placed.planes.empty()) {
      part.to_unit_ball = placed.to_unit_ball;
      part.ball_origin = -(placed.to_unit_ball * to_center);
    }
    parts_.push_back(std::move(part));
  }
  std::sort(parts_.begin(), parts_.end(),
            [](const SeenPart& a, const SeenPart& b) { return a.nearest < b.nearest; });
}

std::vector<int> View::candidates(const RayBundle& bundle, int only_object) const {
  std::vector<int> found;
  const double cosine = std::cos(bundle.half_angle), sine = std::sin(bundle.half_angle);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const SeenPart& part = parts_[i];
    if (only_object >= 0 && part.object != only_object) continue;
    // The angle to its centre exceeds both radii together.
    const double sum_cosine = cosine * part.cos_radius - sine * part.sin_radius;
    const bool apart = bundle.half_angle + part.angular_radius < M_PI &&
                       part.center_direction.dot(bundle.axis) < sum_cosine;
    if (apart) continue;
    const bool beside =
        !part.vertices.empty() &&
        std::any_of(bundle.sides.begin(), bundle.sides.end(),
                    [&](const Eigen::Vector3d& side) { return outside(part.vertices, side); });
    if (!beside) found.push_back(static_cast<int>(i));
  }
  return found;
}

RayHit View::cast(const Eigen::Vector3d& direction, const std::vector<int>& candidates) const {
  RayHit best;
  for (const int i : candidates) {
    const SeenPart& part = parts_[i];
    if (part.nearest > best.range) break;
    if (part.faces.empty()) {
      cast_on_ellipsoid(part, direction, best);
    } else {
      cast_on_polyhedron(part, direction, best);
    }
  }
  return best;
}

void View::cast_on_polyhedron(const SeenPart& part, const Eigen::Vector3d& direction,
                              RayHit& best) {
  double enters = 0, leaves = best.range;
  int face = -1;
  for (std::size_t i = 0; i < part.faces.size(); ++i) {
    const double slope = part.faces[i].normal.dot(direction);
    const double distance = part.faces[i].distance;
    if (slope < 0) {
      const double range = -distance / slope;
      if (range > enters) {
        enters = range;
        face = static_cast<int>(i);
      }
    } else if (distance > 0) {
      return;
    } else if (slope > 0) {
      leaves = std::min(leaves, -distance / slope);
    }
    if (enters >= leaves) return;
  }
  if (face >= 0) best = {enters, part.object, part.part, face, part.faces[face].normal};
}

void View::cast_on_ellipsoid(const SeenPart& part, const Eigen::Vector3d& direction, RayHit& best) {
  const Eigen::Vector3d d = part.to_unit_ball * direction;
  const double a = d.squaredNorm(), b = part.ball_origin.dot(d);
  const double discriminant = b * b - a * (part.ball_origin.squaredNorm() - 1);
  if (discriminant < 0) return;
  const double range = (-b - std::sqrt(discriminant)) / a;
  if (range <= 0 || range >= best.range) return;
  const Eigen::Vector3d on_ball = part.ball_origin + range * d;
  const Eigen::Vector3d normal = (part.to_unit_ball.transpose() * on_ball).normalized();
  best = {range, part.object, part.part, -1, normal};
}

}  // namespace lidar_upsampling::sim
