// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/types.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace lidar_upsampling {

const char* to_string(MotionStatus status) {
  constexpr std::array<const char*, 5> kNames{"moving", "stationary", "predicted", "too_few_points",
                                              "no_consensus"};
  return kNames.at(static_cast<std::size_t>(status));
}

const char* to_string(Resampling resampling) {
  constexpr std::array<const char*, 4> kNames{"none", "done", "little_motion", "no_beams"};
  return kNames.at(static_cast<std::size_t>(resampling));
}

double intersection_over_union(const Box2d& a, const Box2d& b) {
  const Box2d common{std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
                     std::min(a.bottom, b.bottom)};
  const double both = common.area();
  return both > 0 ? both / (a.area() + b.area() - both) : 0;
}

Eigen::Matrix3d position_uncertainty(const ObjectMotion& object) {
  return object.position_covariance + object.unproven_step * object.unproven_step.transpose();
}

double position_sigma(const ObjectMotion& object) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(position_uncertainty(object),
                                                            Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0., axes.eigenvalues()[2]));
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point.cast<double>();
  return sum / std::max<double>(1, static_cast<double>(points.size()));
}

std::vector<Eigen::Vector3f> points_at(const LidarScan& scan, const std::vector<int>& indices) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(indices.size());
  for (const int i : indices) points.push_back(scan.points[i]);
  return points;
}

}  // namespace lidar_upsampling
