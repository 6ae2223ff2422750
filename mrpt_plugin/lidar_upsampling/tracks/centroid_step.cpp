// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/centroid_step.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/tracks/free_space.h"

namespace lidar_upsampling {
namespace {

/// Unit vector across the line of sight to a place, level, lidar frame.
Eigen::Vector2d aside_of(const Eigen::Vector3d& place) {
  return Eigen::Vector2d(-place.y(), place.x()).normalized();
}

/// Whether nothing hides a part of it on either side.
bool is_whole(const ObjectSight& sight, const Eigen::Vector2d& aside) {
  return ends_in_sight(sight, aside) && ends_in_sight(sight, -aside);
}

/// Either scan may show one end of a car, or the other.
double sigma_by_ends(double whole, const ObjectTrack& track, const ScanObject& object) {
  return std::hypot(std::max(0., whole - object.length) / 2,
                    std::max(0., whole - track.length) / 2);
}

}  // namespace

PlanarStep centroid_step(const ObjectTrack& track, const ScanObject& object, const Surface& surface,
                         const TrackedScan& scan, const TrackOptions& options) {
  constexpr double kLeast_m = 0.1, kTurn = 1;  // m, as for association; rad: it does not tell
  const double whole = std::max({object.length, track.whole_length, track.seen ? 0 : kCar_m});
  const double sigma = std::hypot(kLeast_m + options.extent_error * object.length,
                                  sigma_by_ends(whole, track, object));
  PlanarStep step;
  step.mean.head<2>() = (scan.T_rest_lidar * object.centroid - track.centroid_rest).head<2>();
  step.covariance.diagonal() << sigma * sigma, sigma * sigma, kTurn * kTurn;
  if (!track.seen) return step;
  const Eigen::Vector2d before = aside_of(track.T_rest_lidar.inverse() * track.centroid_rest),
                        now = aside_of(object.centroid);
  if (is_whole({track.surface->points(), *track.seen}, before) &&
      is_whole({surface.points(), *scan.seen}, now))
    return step;
  const Eigen::Vector2d aside =
      sigma_by_ends(kCar_m, track, object) * (level_axes(scan.T_rest_lidar.linear()) * now);
  step.covariance.topLeftCorner<2, 2>() += aside * aside.transpose();
  return step;
}

}  // namespace lidar_upsampling
