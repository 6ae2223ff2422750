// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lidar_upsampling/robust/assignment.h"
#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {
namespace {

/// Of a Gaussian in the plane.
double density(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance) {
  return std::exp(-0.5 * astray.dot(covariance.ldlt().solve(astray))) /
         (2 * M_PI * std::sqrt(covariance.determinant()));
}

/// Level covariance of where a place of the scan before lies now, by the ego-motion's.
Eigen::Matrix2d ego_error(const TrackedScan& scan, const Eigen::Vector3d& place) {
  Eigen::Matrix<double, 3, 6> by_twist;
  by_twist << -skew(place), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d covariance = by_twist * scan.step_covariance * by_twist.transpose();
  const Eigen::Matrix2d turn = scan.T_rest_lidar.linear().topLeftCorner<2, 2>();
  return turn * covariance.topLeftCorner<2, 2>() * turn.transpose();
}

}  // namespace

std::vector<int> associate(const std::vector<ObjectTrack>& tracks,
                           const std::vector<ScanObject>& objects, const TrackedScan& scan,
                           const TrackOptions& options) {
  constexpr double kSizeRatio = 0.7;   // of what two scans show of one object, in e-folds
  constexpr double kRise_m = 0.3;      // of its centroid
  constexpr double kLeast_m = 0.1;     // by which any centroid shifts
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(objects.size()),
                                                   static_cast<Eigen::Index>(tracks.size()), 0.);
  for (std::size_t j = 0; j < tracks.size(); ++j) {
    const ObjectTrack& track = tracks[j];
    const double is_moving = 1 / (1 + std::exp(-track.latest_log_odds));
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const ScanObject& object = objects[i];
      const Eigen::Vector3d at = scan.T_rest_lidar * object.centroid;
      const double shift = kLeast_m + options.extent_error * object.length;
      const Eigen::Matrix2d parked =
          shift * shift * Eigen::Matrix2d::Identity() + ego_error(scan, object.centroid);
      const Eigen::Vector3d step = at - track.centroid_rest;
      const TrackState now = predicted(track.latest, shifted(scan.scan.stamp, object.time_s), options.noise);
      const double here =
          is_moving * density(step.head<2>() - now.mean.head<2>(),
                              parked + now.covariance.topLeftCorner<2, 2>()) +
          (1 - is_moving) * density(step.head<2>(), parked);
      if (!(here > 0)) continue;
      const double size = static_cast<double>(object.points.size()) * object.centroid.squaredNorm();
      const double log_ratio = std::log(here / options.birth_density) -
                               0.5 * std::pow(std::log(size / track.size) / kSizeRatio, 2) -
                               0.5 * std::pow(step.z() / kRise_m, 2);
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = std::min(0., -log_ratio);
    }
  }
  if (tracks.empty()) return std::vector<int>(objects.size(), -1);
  return solve_assignment(cost, 0.);
}

}  // namespace lidar_upsampling
