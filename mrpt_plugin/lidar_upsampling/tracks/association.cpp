// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/robust/assignment.h"
#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {
namespace {

/// How much likelier the object is this track than a new one, as a logarithm.
double log_ratio(const ObjectTrack& track, const ScanObject& object, const TrackedScan& scan,
                 const TrackOptions& options) {
  constexpr double kSizeRatio = 0.7;  // of what two scans show of one object, in e-folds
  constexpr double kRise_m = 0.3;     // of its centroid, as other rings meet it
  constexpr double kLeast_m = 0.1;    // by which any centroid shifts: a ring more or less
  constexpr double kCertain = 50;     // the detector's own identity outweighs all else
  if (track.external_id >= 0 && object.external_id >= 0)
    return track.external_id == object.external_id ? kCertain : -kCertain;
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  // What only one of the scans shows of it shifts its centroid by a half.
  const double shift = kLeast_m + options.extent_error * object.length +
                       0.5 * std::abs(object.length - track.length);
  const Eigen::Matrix2d parked =
      shift * shift * Eigen::Matrix2d::Identity() + ego_error(scan, object.centroid);
  const Eigen::Vector3d step = scan.T_rest_lidar * object.centroid - track.centroid_rest;
  const double is_moving = probability_of(track.latest_log_odds);
  double if_moving = 0;
  for (const Course& course : courses_of(track, options)) {
    const TrackState now = predicted(course.from, instant, options.noise);
    if_moving +=
        course.probability * gaussian_density(step.head<2>() - now.mean.head<2>(),
                                              parked + now.covariance.topLeftCorner<2, 2>());
  }
  const double here =
      is_moving * if_moving + (1 - is_moving) * gaussian_density(step.head<2>(), parked);
  const double size = static_cast<double>(object.points.size()) * object.centroid.squaredNorm();
  // Cauchy: one that comes out from behind another shows anything from a sliver to all of it.
  return std::log(here / options.birth_density) -
         std::log1p(std::pow(std::log(size / track.size) / kSizeRatio, 2)) -
         0.5 * std::pow(step.z() / kRise_m, 2);
}

}  // namespace

std::vector<int> associate(const std::vector<ObjectTrack>& tracks,
                           const std::vector<ScanObject>& objects, const TrackedScan& scan,
                           const TrackOptions& options) {
  if (tracks.empty()) return std::vector<int>(objects.size(), -1);
  CostMatrix cost(objects.size(), tracks.size());
  for (Eigen::Index i = 0; i < cost.rows(); ++i)
    for (Eigen::Index j = 0; j < cost.cols(); ++j)
      cost(i, j) = std::min(0., -log_ratio(tracks[j], objects[i], scan, options));
  return solve_assignment(cost, 0.);
}

}  // namespace lidar_upsampling
