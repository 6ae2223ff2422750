// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <limits>

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// A part of the world at one instant, in the world frame.
struct PlacedPart {
  int object = 0;
  int part = 0;
  std::vector<Plane> planes;
  std::vector<Eigen::Vector3d> vertices;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;             ///< of the bounding sphere
  Eigen::Matrix3d to_unit_ball;  ///< of an ellipsoid's (point - center)
};

/// The world at one instant.
struct Scene {
  double t = 0;
  std::vector<Pose> T_world_object;
  std::vector<PlacedPart> parts;
};

/// @param matters whether the parts of an object, of this pose, are wanted; none: all are.
[[nodiscard]] Scene scene_at(
    const World& world, double t,
    const std::function<bool(const Object&, const Pose& T_world_object)>& matters = {});

struct RayHit {
  double range = std::numeric_limits<double>::infinity();
  int object = -1;  ///< -1: nothing was hit
  int part = -1;
  int face = -1;  ///< the plane of the part that was hit; -1 on an ellipsoid
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< world frame

  [[nodiscard]] bool any() const { return object >= 0; }
};

/// A bundle of neighbouring rays: a cone about `axis`, narrowed by planes through the rays' common
/// origin whose normals point out of the bundle.
struct RayBundle {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double half_angle = M_PI;
  std::vector<Eigen::Vector3d> sides;
};

/// @brief The scene as seen from one point: answers which part a ray meets first, exactly. Since
/// all rays start at one point, a plane costs one dot product.
class View {
 public:
  View(const Scene& scene, const Eigen::Vector3d& origin);

  /// Parts that a ray of the bundle may meet, nearest first; `only_object` >= 0: of this object
  /// alone.
  [[nodiscard]] std::vector<int> candidates(const RayBundle& bundle, int only_object = -1) const;
  /// The first hit of a ray with unit direction, world frame.
  [[nodiscard]] RayHit cast(const Eigen::Vector3d& direction,
                            const std::vector<int>& candidates) const;

 private:
  struct Face {
    Eigen::Vector3d normal;
    double distance;  ///< of the origin, positive outside
  };
  struct SeenPart {
    int object, part;
    std::vector<Face> faces;
    std::vector<Eigen::Vector3d> vertices;  ///< from the origin
    Eigen::Vector3d center_direction;
    double angular_radius, cos_radius, sin_radius;
    double nearest;  ///< no point of it is closer to the origin
    Eigen::Vector3d ball_origin;
    Eigen::Matrix3d to_unit_ball;
  };

  static void cast_on_polyhedron(const SeenPart& part, const Eigen::Vector3d& direction,
                                 RayHit& best);
  static void cast_on_ellipsoid(const SeenPart& part, const Eigen::Vector3d& direction,
                                RayHit& best);

  std::vector<SeenPart> parts_;
};

}  // namespace lidar_upsampling::sim
