// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <vector>

#include "lidar_upsampling/robust/ransac.h"
#include "lidar_upsampling/vision/absolute_pose.h"

namespace lidar_upsampling {

/// A correspondence freed of its lens: near the normalised coordinates, pixels are their affine
/// image.
struct Observation {
  Eigen::Vector3d point_in_source;
  Eigen::Vector2d normalised;  ///< (x/z, y/z) of the ray through the pixel
  Eigen::Matrix2d pixel_by_normalised;
  int index;  ///< of the correspondence
};

/// @brief Undistorts once what every hypothesis needs; leaves out pixels the lens model does not
/// hold for.
/// @throw std::invalid_argument camera model out of range, a coordinate that is not finite.
[[nodiscard]] std::vector<Observation> observe(const std::vector<Correspondence>& correspondences,
                                               const CameraModel& model);

/// @brief Squared pixel distance between observation and projection, exact for small ones; infinity
/// behind the camera.
[[nodiscard]] double sq_reprojection_error(const Observation& observation,
                                           const Pose& T_camera_source);

/// @brief P3P hypotheses scored by the negative log likelihood of a mixture of Gaussian inliers and
/// uniform outliers, its mixing parameter found by EM (Torr & Zisserman, CVIU 2000, eqs. 17-19).
class MlesacPose {
 public:
  using Model = Pose;
  static constexpr std::size_t sample_size = 3;

  MlesacPose(const std::vector<Observation>& observations, const AbsolutePoseOptions& options);

  [[nodiscard]] int num_data() const { return static_cast<int>(observations_.size()); }
  void generate_models(const std::array<int, sample_size>& sample, std::vector<Pose>* models) const;
  [[nodiscard]] ModelScore score_model(const Pose& T_camera_source) const;

  /// Two Gauss-Newton steps on the inliers.
  void refine_model(Pose& T_camera_source) const;

 private:
  const std::vector<Observation>& observations_;
  std::vector<Eigen::Vector3d> bearings_;
  double sigma_px_;
  double outlier_density_;
  double max_sq_error_;
};

}  // namespace lidar_upsampling
