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

/// The same direction as of (-pi/2, pi/2].
double without_sense(double yaw) {
  const double within = std::remainder(yaw, M_PI);
  return within <= -M_PI / 2 ? within + M_PI : within;
}

}  // namespace

double yaw_of_sides(const std::vector<Eigen::Vector3f>& points) {
  constexpr std::size_t kMostPoints = 200;  // so many draw two sides to some centimetres
  constexpr int kStep_deg = 2;
  constexpr float kWidest_m = 2.3F;  // of cars, with mirrors
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
  const double across = best + M_PI / 2;
  const double longer =
      extent_of(along(places, across)) > extent_of(along(places, best)) ? across : best;
  const Eigen::Vector2f middle = places.rowwise().mean();
  const double sight = std::atan2(middle.y(), middle.x());
  const bool is_across_sight = std::abs(without_sense(longer - sight)) > M_PI / 4;
  const bool is_end = is_across_sight && extent_of(along(places, longer)) < kWidest_m;
  return without_sense(is_end ? longer + M_PI / 2 : longer);
}

}  // namespace lidar_upsampling
