// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/types.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace lidar_upsampling {

const char* to_string(MotionStatus status) {
  switch (status) {
    case MotionStatus::moving:
      return "moving";
    case MotionStatus::stationary:
      return "stationary";
    case MotionStatus::predicted:
      return "predicted";
    case MotionStatus::too_few_points:
      return "too_few_points";
    case MotionStatus::no_consensus:
      return "no_consensus";
  }
  return "unknown";
}

const char* to_string(Resampling resampling) {
  switch (resampling) {
    case Resampling::none:
      return "none";
    case Resampling::done:
      return "done";
    case Resampling::little_motion:
      return "little_motion";
    case Resampling::no_beams:
      return "no_beams";
  }
  return "unknown";
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
