// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace lidar_upsampling::sim {

/// `normal` points out of the solid; inside is normal·p <= offset.
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0;
};

/// @brief A convex solid: the intersection of half-spaces, or, without any, an ellipsoid with axes
/// along x, y and z. Metres, in its object's frame.
struct Solid {
  std::vector<Plane> planes;
  std::vector<Eigen::Vector3d> vertices;  ///< none: an ellipsoid, or unbounded
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d radii = Eigen::Vector3d::Zero();  ///< of an ellipsoid
  double bounding_radius = 0;                       ///< about `center`; infinite if unbounded
};

/// A point of a convex polygon in the plane of an extrusion.
using Profile = std::vector<Eigen::Vector2d>;

[[nodiscard]] Solid ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii);
[[nodiscard]] Solid box(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest);
/// An (x, z) polygon, counter-clockwise with x to the right and z up, extruded over y.
[[nodiscard]] Solid extruded_along_y(const Profile& xz, double y_from, double y_to);
/// An (y, z) polygon, counter-clockwise with y to the right and z up, extruded over x.
[[nodiscard]] Solid extruded_along_x(const Profile& yz, double x_from, double x_to);
/// A prism with `sides` sides about a vertical axis, tapering to `top_radius`.
[[nodiscard]] Solid upright_prism(const Eigen::Vector3d& foot, double radius, double top_radius,
                                  double height, int sides);
/// Possibly unbounded.
[[nodiscard]] Solid intersection(std::vector<Plane> planes);
/// What is left of a polyhedron behind more planes.
[[nodiscard]] Solid cut(Solid solid, const std::vector<Plane>& planes);
/// The plane through `point`.
[[nodiscard]] Plane plane_through(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

/// Signed distance to the surface, negative inside: exact on the surface, a lower bound off it.
[[nodiscard]] double signed_distance(const Solid& solid, const Eigen::Vector3d& point);

}  // namespace lidar_upsampling::sim
