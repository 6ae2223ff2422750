// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/sides.h"

#include <cmath>

#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr float kNear_m = 0.05F;  // nearer to a side, points tell their own noise

/// The places of points along one direction.
Eigen::ArrayXf along(const Eigen::Matrix2Xf& places, double yaw) {
  const Eigen::Vector2f direction(static_cast<float>(std::cos(yaw)),
                                  static_cast<float>(std::sin(yaw)));
  return (direction.transpose() * places).transpose().array();
}

Eigen::ArrayXf to_nearer_end(const Eigen::ArrayXf& places) {
  return (places - places.minCoeff()).min(places.maxCoeff() - places);
}

float extent_of(const Eigen::ArrayXf& places) { return places.maxCoeff() - places.minCoeff(); }

}  // namespace

double yaw_of_sides(const std::vector<Eigen::Vector3f>& points) {
  constexpr std::size_t kMostPoints = 200;  // so many draw two sides to some centimetres
  constexpr int kStep_deg = 2;
  const std::vector<Eigen::Vector3f> some = evenly_thinned(points, kMostPoints);
  Eigen::Matrix2Xf places(2, static_cast<Eigen::Index>(some.size()));
  for (std::size_t i = 0; i < some.size(); ++i)
    places.col(static_cast<Eigen::Index>(i)) = some[i].head<2>();
  double best = 0;
  float closest = 0;
  for (int degrees = 0; degrees < 90; degrees += kStep_deg) {
    const double yaw = degrees * kDegree;
    const Eigen::ArrayXf off =
        to_nearer_end(along(places, yaw)).min(to_nearer_end(along(places, yaw + M_PI / 2)));
    const float closeness = off.max(kNear_m).inverse().sum();
    if (closeness <= closest) continue;
    closest = closeness;
    best = yaw;
  }
  const bool is_across = extent_of(along(places, best + M_PI / 2)) > extent_of(along(places, best));
  if (!is_across) return best;
  return best > 0 ? best - M_PI / 2 : M_PI / 2;
}

}  // namespace lidar_upsampling
