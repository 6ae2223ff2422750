// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/observation.h"

#include <limits>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/vision/distortion.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

std::vector<Observation> observe(const std::vector<Correspondence>& correspondences,
                                 const CameraModel& model) {
  check(model);
  const double max_radius = valid_radius(model);
  const Eigen::Vector2d focal(model.fx, model.fy);
  std::vector<Observation> observations;
  observations.reserve(correspondences.size());
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const Eigen::Vector3d& point = correspondences[i].point_in_source;
    const Eigen::Vector2d& pixel = correspondences[i].pixel;
    if (!point.allFinite() || !pixel.allFinite()) {
      throw std::invalid_argument("absolute pose: correspondence " + std::to_string(i) +
                                  " has a coordinate that is not a finite number");
    }
    const Eigen::Vector2d distorted =
        (pixel - Eigen::Vector2d(model.cx, model.cy)).cwiseQuotient(focal);
    const auto normalised = undistort_normalised(model, distorted, max_radius);
    if (!normalised) continue;
    observations.push_back({point, *normalised,
                            focal.asDiagonal() * distort(model, *normalised).jacobian,
                            static_cast<int>(i)});
  }
  return observations;
}

void weigh_by_texture(std::vector<Observation>& observations,
                      const std::vector<Correspondence>& correspondences, double sigma_px) {
  for (Observation& observation : observations) {
    const Eigen::Matrix2d in_sigmas =
        Eigen::Matrix2d::Identity() +
        correspondences[observation.index].covariance / (sigma_px * sigma_px);
    const SymmetricEigen<2> eigen = symmetric_eigen<2>(in_sigmas);
    const Eigen::Matrix2d inverse_root = eigen.vectors *
                                         eigen.values.cwiseInverse().cwiseSqrt().asDiagonal() *
                                         eigen.vectors.transpose();
    observation.pixel_by_normalised = inverse_root * observation.pixel_by_normalised;
  }
}

double sq_reprojection_error(const Observation& observation, const Pose& T_camera_source) {
  const Eigen::Vector3d point = T_camera_source * observation.point_in_source;
  if (!(point.z() > kNearestDepth)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d difference = point.head<2>() / point.z() - observation.normalised;
  return (observation.pixel_by_normalised * difference).squaredNorm();
}

std::optional<Reprojection> reprojection(const Observation& observation,
                                         const Pose& T_camera_source) {
  const Eigen::Vector3d point = T_camera_source * observation.point_in_source;
  if (!(point.z() > kNearestDepth)) return std::nullopt;
  const double inverse_z = 1 / point.z();
  const Eigen::Vector2d normalised = point.head<2>() * inverse_z;
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << inverse_z, 0, -normalised.x() * inverse_z, 0, inverse_z, -normalised.y() * inverse_z;
  by_point = observation.pixel_by_normalised * by_point;
  Reprojection result;
  result.residual = observation.pixel_by_normalised * (normalised - observation.normalised);
  result.jacobian.leftCols<3>() = -by_point * skew(point);
  result.jacobian.rightCols<3>() = by_point;
  return result;
}

}  // namespace lidar_upsampling
