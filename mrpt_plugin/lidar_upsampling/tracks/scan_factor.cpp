// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/scan_factor.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lidar_upsampling/objects/known_motion.h"

namespace lidar_upsampling {
namespace {

/// An object's sights in two scans.
struct TwoSights {
  ObjectScans scans;
  Stamp instant;  ///< of the second one
  Eigen::Matrix2d axes_before, axes_now;
};

TwoSights two_sights(const ObjectTrack& track, const ScanObject& object, const TrackedScan& scan,
                     const TrackState& expected) {
  TwoSights sights;
  sights.instant = expected.stamp;
  sights.axes_before = level_axes(track.T_rest_lidar.linear());
  sights.axes_now = level_axes(scan.T_rest_lidar.linear());
  // Over ground, about the centroid, in the axes of the lidar frame then.
  Twist motion = Twist::Zero();
  motion[2] = expected.mean[2];
  motion.segment<2>(3) = sights.axes_before.transpose() * expected.mean.head<2>();
  sights.scans = {track.points, points_at(scan.scan, object.points),
                  scan.T_rest_lidar.inverse() * track.T_rest_lidar,
                  motion_pose(motion, track.T_rest_lidar.inverse() * track.centroid_rest),
                  seconds_between(track.stamp, expected.stamp)};
  return sights;
}

std::optional<PlanarStep> registered_step(const TwoSights& sights, const TrackedScan& scan) {
  constexpr double kYaw = 0.05;  // rad, of a registration: 10 cm at the ends of a car
  const double dt = sights.scans.dt;
  const auto measured =
      measure_between_scans(sights.scans, sights.instant, scan.T_rest_lidar.linear());
  if (!measured) return {};
  PlanarStep step;
  step.mean << dt * measured->velocity_at_rest.head<2>(), dt * measured->yaw_rate;
  step.covariance.topLeftCorner<2, 2>() = dt * dt * measured->velocity_covariance;
  step.covariance(2, 2) = kYaw * kYaw;
  return step;
}

/// Where nothing can be registered, the centroid tells.
PlanarStep centroid_step(const ObjectTrack& track, const ScanObject& object,
                         const TrackedScan& scan, const TrackOptions& options) {
  constexpr double kLeast_m = 0.1, kTurn = 1;  // m, as for association; rad: it does not tell
  const double sigma = kLeast_m + options.extent_error * object.length;
  PlanarStep step;
  step.mean.head<2>() = (scan.T_rest_lidar * object.centroid - track.centroid_rest).head<2>();
  step.covariance.diagonal() << sigma * sigma, sigma * sigma, kTurn * kTurn;
  return step;
}

/// Whether each scan saw a surface where the other one shows the object, so that it cannot have
/// made the step.
bool was_there_all_along(const TwoSights& sights, const PlanarStep& step, const TrackedScan& scan) {
  const double dt = sights.scans.dt;
  if (scan.seen_before == nullptr ||
      std::abs(dt - seconds_between(scan.stamp_before, scan.scan.stamp)) > 0.5 * dt)
    return false;
  const Eigen::Vector2d d = step.mean.head<2>();
  const Pose& T_k_before = sights.scans.T_lidar_k_lidar_before;
  return was_there_then({sights.scans.now, scan.seen, true}, sights.axes_now.transpose() * d,
                        T_k_before.inverse(), *scan.seen_before) &&
         was_there_then({sights.scans.before, *scan.seen_before, true},
                        -(sights.axes_before.transpose() * d), T_k_before, scan.seen);
}

/// Of a step that may also be a registration gone astray.
double log_likelihood(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance,
                      const TrackOptions& options) {
  const double inlier = std::exp(-0.5 * astray.dot(covariance.inverse() * astray)) /
                        (2 * M_PI * std::sqrt(covariance.determinant()));
  return std::log((1 - options.outlier_share) * inlier +
                  options.outlier_share * options.outlier_density);
}

}  // namespace

double prior_log_odds(const TrackOptions& options) {
  return std::log(options.moving_prior / (1 - options.moving_prior));
}

ScanLesson learn_from_scans(const ObjectTrack& track, const ScanObject& object,
                            const TrackedScan& scan, const TrackOptions& options) {
  constexpr double kCreep_m = 0.01;       // of what stands: points are this coarse
  constexpr double kContradiction = 4.6;  // a hundred to one, of the free-space test
  constexpr double kWrong = 13.8;         // chi-square of two degrees of freedom, one in a thousand
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  const double dt = seconds_between(track.stamp, instant);
  const TrackState expected =
      predicted(options.image_factor ? track.latest : track.state, instant, options.noise);
  const double prior = prior_log_odds(options);
  const double known = options.image_factor ? track.latest_log_odds : track.log_odds;
  ScanLesson lesson{expected, prior + (known - prior) * std::exp(-dt / options.memory_s)};
  if (!options.scan_factor) return lesson;

  const TwoSights sights = two_sights(track, object, scan, expected);
  const auto registered = registered_step(sights, scan);
  PlanarStep step = registered ? *registered : centroid_step(track, object, scan, options);
  if (registered && was_there_all_along(sights, step, scan)) lesson.log_odds -= kContradiction;
  // Ego-motion's error moves all that is measured from one scan to the other.
  step.covariance.topLeftCorner<2, 2>() += ego_error(scan, object.centroid);
  const Eigen::Matrix2d R = step.covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix2d S = expected.covariance.topLeftCorner<2, 2>() + R;
  const Eigen::Vector2d d = step.mean.head<2>(), astray = d - expected.mean.head<2>();
  lesson.log_odds +=
      log_likelihood(astray, S, options) -
      log_likelihood(d, R + kCreep_m * kCreep_m * Eigen::Matrix2d::Identity(), options);
  lesson.log_odds = std::clamp(lesson.log_odds, -kMostLogOdds, kMostLogOdds);
  const bool surprises = astray.dot(S.inverse() * astray) > kWrong;
  const TrackState base =
      surprises ? predicted(new_track_state(track.stamp, options.noise), instant, options.noise)
                : expected;
  lesson.state = updated(base, step);
  return lesson;
}

}  // namespace lidar_upsampling
