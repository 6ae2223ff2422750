// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/solid.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace lidar_upsampling::sim {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool inside(const std::vector<Plane>& planes, const Eigen::Vector3d& p) {
  for (const Plane& plane : planes) {
    if (plane.normal.dot(p) > plane.offset + 1e-7) return false;
  }
  return true;
}

// Every corner is where three planes meet; solids have some twenty planes, so all triples are
// tried.
std::vector<Eigen::Vector3d> find_vertices(const std::vector<Plane>& planes) {
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t a = 0; a < planes.size(); ++a) {
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      for (std::size_t c = b + 1; c < planes.size(); ++c) {
        Eigen::Matrix3d normals;
        normals << planes[a].normal.transpose(), planes[b].normal.transpose(),
            planes[c].normal.transpose();
        if (std::abs(normals.determinant()) < 1e-6) continue;
        const Eigen::Vector3d p =
            normals.inverse() *
            Eigen::Vector3d(planes[a].offset, planes[b].offset, planes[c].offset);
        if (inside(planes, p)) vertices.push_back(p);
      }
    }
  }
  return vertices;
}

void bound_by_vertices(Solid& solid) {
  solid.vertices = find_vertices(solid.planes);
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3d& v : solid.vertices) extent.extend(v);
  if (extent.isEmpty()) throw std::invalid_argument("solid: its planes enclose nothing");
  solid.center = extent.center();
  solid.bounding_radius = 0;
  for (const Eigen::Vector3d& v : solid.vertices) {
    solid.bounding_radius = std::max(solid.bounding_radius, (v - solid.center).norm());
  }
}

// Outward normals of a counter-clockwise polygon, `to_3d` placing the polygon's plane.
template <typename To3d>
std::vector<Plane> side_planes(const Profile& polygon, const To3d& to_3d) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& from = polygon[i];
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - from;
    const Eigen::Vector2d outward(edge.y(), -edge.x());
    planes.push_back(plane_through(to_3d(from), to_3d(outward)));
  }
  return planes;
}

}  // namespace

Plane plane_through(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d unit = normal.normalized();
  return {unit, unit.dot(point)};
}

Solid ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii) {
  Solid solid;
  solid.center = center;
  solid.radii = radii;
  solid.bounding_radius = radii.maxCoeff();
  return solid;
}

Solid box(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest) {
  std::vector<Plane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    planes.push_back({unit, highest[axis]});
    planes.push_back({-unit, -lowest[axis]});
  }
  return cut({}, planes);
}

Solid extruded_along_y(const Profile& xz, double y_from, double y_to) {
  auto planes =
      side_planes(xz, [](const Eigen::Vector2d& p) { return Eigen::Vector3d(p.x(), 0, p.y()); });
  planes.push_back({Eigen::Vector3d::UnitY(), y_to});
  planes.push_back({-Eigen::Vector3d::UnitY(), -y_from});
  return cut({}, planes);
}

Solid extruded_along_x(const Profile& yz, double x_from, double x_to) {
  auto planes =
      side_planes(yz, [](const Eigen::Vector2d& p) { return Eigen::Vector3d(0, p.x(), p.y()); });
  planes.push_back({Eigen::Vector3d::UnitX(), x_to});
  planes.push_back({-Eigen::Vector3d::UnitX(), -x_from});
  return cut({}, planes);
}

Solid upright_prism(const Eigen::Vector3d& foot, double radius, double top_radius, double height,
                    int sides) {
  std::vector<Plane> planes{{Eigen::Vector3d::UnitZ(), foot.z() + height},
                            {-Eigen::Vector3d::UnitZ(), -foot.z()}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector3d normal =
        height * outward + (radius - top_radius) * Eigen::Vector3d::UnitZ();
    planes.push_back(plane_through(foot + radius * outward, normal));
  }
  return cut({}, planes);
}

Solid intersection(std::vector<Plane> planes) {
  Solid solid;
  solid.planes = std::move(planes);
  solid.bounding_radius = kInfinity;
  return solid;
}

Solid cut(Solid solid, const std::vector<Plane>& planes) {
  solid.planes.insert(solid.planes.end(), planes.begin(), planes.end());
  bound_by_vertices(solid);
  return solid;
}

double signed_distance(const Solid& solid, const Eigen::Vector3d& point) {
  if (solid.planes.empty()) {
    const double scaled = (point - solid.center).cwiseQuotient(solid.radii).norm();
    return (scaled - 1) * solid.radii.minCoeff();
  }
  double distance = -kInfinity;
  for (const Plane& plane : solid.planes) {
    distance = std::max(distance, plane.normal.dot(point) - plane.offset);
  }
  return distance;
}

}  // namespace lidar_upsampling::sim
