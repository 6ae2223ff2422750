// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "lidar_upsampling/robust/ransac.h"
#include "lidar_upsampling/vision/observation.h"

namespace lidar_upsampling {

/// @brief P3P hypotheses scored by the negative log likelihood of a mixture of Gaussian inliers and
/// uniform outliers, its mixing parameter found by EM (Torr & Zisserman, CVIU 2000).
class MlesacPose {
 public:
  using Model = Pose;
  static constexpr std::size_t sample_size = 3;

  MlesacPose(const std::vector<Observation>& observations, const AbsolutePoseOptions& options);

  [[nodiscard]] int num_data() const { return static_cast<int>(observations_.size()); }
  void generate_models(const std::array<int, sample_size>& sample, std::vector<Pose>* models) const;

  /// @return infinite cost for what cannot beat the best pose scored before.
  [[nodiscard]] ModelScore score_model(const Pose& T_camera_source);

  /// Two Gauss-Newton steps on the inliers.
  void refine_model(Pose& T_camera_source) const;

 private:
  const std::vector<Observation>& observations_;
  std::vector<Eigen::Vector3d> bearings_;
  double sigma_px_;
  double outlier_density_;
  double max_sq_error_;
  double lowest_cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace lidar_upsampling
