// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/common_errors.h"

#include <cmath>

namespace lidar_upsampling {

Matrix6d ego_error(const MotionQuestion& question) {
  const Pose& T_lidar_t_lidar_k = question.T_lidar_t_lidar_k;
  const Matrix6d by_twist =
      increment_at(T_lidar_t_lidar_k * question.centroid, T_lidar_t_lidar_k.linear().transpose());
  return by_twist * question.ego_covariance * by_twist.transpose();
}

Matrix6d picture_error(const MotionQuestion& question, const ImageFactor& image, double sigma_px,
                       const TrackOptions& options) {
  constexpr double kPatch_px = 5;     // a single point is as wide as its patch
  constexpr double kOfScatter = 0.6;  // no unit
  const double range = question.centroid.norm(), m_per_px = range / question.focal_px;
  const Eigen::Vector3d ahead = question.centroid / range;
  const auto count = static_cast<double>(image.observations.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Observation& seen : image.observations) middle += seen.point_in_source;
  middle /= count;
  double sq_width = std::pow(kPatch_px * m_per_px, 2);
  for (const Observation& seen : image.observations)
    sq_width += ahead.cross(seen.point_in_source - middle).squaredNorm() / count;
  const double sq_shift = std::pow(options.common_error_px * m_per_px, 2);
  const double sq_share = std::pow(kOfScatter * sigma_px * m_per_px, 2) / sq_width;  // of its size
  Matrix6d error = Matrix6d::Zero();
  error.diagonal() << Eigen::Vector3d::Constant(sq_share), Eigen::Vector3d::Constant(sq_shift);
  error.bottomRightCorner<3, 3>() += sq_share * range * range * ahead * ahead.transpose();
  return error;
}

}  // namespace lidar_upsampling
