// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <random>

#include "lidar_upsampling/vision/absolute_pose.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

struct PoseProblem {
  CameraModel model{1242, 375, 720, 720, 610, 173, DistortionModel::none, {}};
  Pose truth = Pose::Identity();
  std::vector<Correspondence> correspondences;
  std::vector<bool> is_outlier;
};

struct ProblemOptions {
  int num_points = 100;
  double noise_px = 0;
  double outliers = 0;  ///< part of all
  double distance = 15;
  std::uint32_t seed = 1;
};

/// A car's visible sides, `distance` metres ahead, seen after a motion of the scanner of about 1 m
/// and 2 degrees. Outliers are off by up to 20 px.
inline PoseProblem make_pose_problem(const ProblemOptions& options, PoseProblem problem = {}) {
  std::mt19937 generator(options.seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::normal_distribution<double> noise(0, 1);
  problem.truth.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  problem.truth.linear() =
      problem.truth.linear() *
      Eigen::AngleAxisd(0.035, Eigen::Vector3d(0.1, 0.2, 1).normalized()).toRotationMatrix();
  problem.truth.translation() << 0.3, -0.1, -1.2;
  while (static_cast<int>(problem.correspondences.size()) < options.num_points) {
    const bool on_side = unit(generator) > 0;
    const Eigen::Vector3d point(options.distance + (on_side ? 2 + 2 * unit(generator) : 0),
                                on_side ? 0.9 : 0.9 * unit(generator), -1 + 0.7 * unit(generator));
    auto pixel = project(problem.model, problem.truth * point);
    if (!pixel) continue;
    const bool outlier =
        static_cast<double>(problem.correspondences.size()) < options.outliers * options.num_points;
    if (outlier) {
      const double angle = M_PI * unit(generator);
      *pixel += (12 + 8 * unit(generator)) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    } else {
      *pixel += options.noise_px * Eigen::Vector2d(noise(generator), noise(generator));
    }
    problem.correspondences.push_back({point, *pixel});
    problem.is_outlier.push_back(outlier);
  }
  return problem;
}

/// How far the pose misplaces the object's middle, in metres.
inline double position_error(const PoseProblem& problem, const Pose& pose) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& correspondence : problem.correspondences) mean += correspondence.point_in_source;
  mean /= static_cast<double>(problem.correspondences.size());
  return (pose * mean - problem.truth * mean).norm();
}

}  // namespace lidar_upsampling
