// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/scan_factor.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/tracks/free_space.h"
#include "lidar_upsampling/tracks/registered_step.h"

namespace lidar_upsampling {
namespace {

/// An object's sights in two scans.
struct TwoSights {
  ObjectScans scans;
  double dt = 0;  ///< s
  Eigen::Matrix2d axes_before, axes_now;
};

TwoSights two_sights(const ObjectTrack& track, const ScanObject& object, const TrackedScan& scan,
                     const TrackState& expected) {
  TwoSights sights;
  sights.dt = seconds_between(track.stamp, expected.stamp);
  sights.axes_before = level_axes(track.T_rest_lidar.linear());
  sights.axes_now = level_axes(scan.T_rest_lidar.linear());
  // Over ground, about the centroid, in the axes of the lidar frame then.
  Twist motion = Twist::Zero();
  motion[2] = expected.mean[2];
  motion.segment<2>(3) = sights.axes_before.transpose() * expected.mean.head<2>();
  sights.scans = {track.points, points_at(scan.scan, object.points),
                  scan.T_rest_lidar.inverse() * track.T_rest_lidar,
                  motion_pose(motion, track.T_rest_lidar.inverse() * track.centroid_rest)};
  const double between = seconds_between(scan.stamp_before, scan.scan.stamp);
  if (scan.seen_before != nullptr && std::abs(sights.dt - between) < 0.5 * sights.dt) {
    sights.scans.seen_before = scan.seen_before;
    sights.scans.seen_now = &scan.seen;
  }
  return sights;
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
  if (sights.scans.seen_before == nullptr) return false;
  const Eigen::Vector2d d = step.mean.head<2>();
  const Pose& T_k_before = sights.scans.T_lidar_k_lidar_before;
  return was_there_then({sights.scans.now, scan.seen}, sights.axes_now.transpose() * d,
                        T_k_before.inverse(), *scan.seen_before) &&
         was_there_then({sights.scans.before, *scan.seen_before},
                        -(sights.axes_before.transpose() * d), T_k_before, scan.seen);
}

/// Whether some of its surface lies across a direction, and not along it.
bool has_face_across(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector2d& d) {
  constexpr float kAcross = 0.5F;  // within 60 degrees
  constexpr double kShare = 0.1;
  const Surface surface(points);
  int across = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    across +=
        std::abs(surface.normal(static_cast<int>(i)).head<2>().dot(d.cast<float>())) > kAcross;
  return across > kShare * static_cast<double>(points.size());
}

/// Whether what is seen of the object tells a step: by a face across it, or an end that both scans
/// show. Else its ends are the edges of what hides the rest of it, and their steps are not its own.
bool tells_step(const TwoSights& sights, const Eigen::Vector2d& step, const TrackedScan& scan) {
  if (sights.scans.seen_before == nullptr || step.norm() < 1e-3) return true;
  const Eigen::Vector2d d = step.normalized();
  if (has_face_across(sights.scans.now, sights.axes_now.transpose() * d)) return true;
  const ObjectSight before{sights.scans.before, *sights.scans.seen_before};
  const ObjectSight now{sights.scans.now, scan.seen};
  const Eigen::Vector2d d_before = sights.axes_before.transpose() * d;
  const Eigen::Vector2d d_now = sights.axes_now.transpose() * d;
  return (ends_in_sight(before, d_before) && ends_in_sight(now, d_now)) ||
         (ends_in_sight(before, -d_before) && ends_in_sight(now, -d_now));
}

/// Of a Gaussian in the plane.
double density(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance) {
  return std::exp(-0.5 * astray.dot(covariance.inverse() * astray)) /
         (2 * M_PI * std::sqrt(covariance.determinant()));
}

/// A step's likelihoods. A registration gone astray leads anywhere or, of what moves, sticks to
/// where that was: views of what comes into sight look as if it stood.
struct Likelihoods {
  double stuck = 0;  ///< moving, and the registration wrong
  double parked = 0;
  double moving = 0;  ///< or wrong
};

Likelihoods likelihoods(const PlanarStep& step, const TrackState& expected,
                        const TrackOptions& options) {
  constexpr double kCreep_m = 0.01;  // of what stands: points are this coarse
  const Eigen::Vector2d d = step.mean.head<2>();
  const Eigen::Matrix2d R = step.covariance.topLeftCorner<2, 2>();
  const double share = options.outlier_share, astray = share * options.outlier_density;
  const double stands = density(d, R + kCreep_m * kCreep_m * Eigen::Matrix2d::Identity());
  const double moves =
      density(d - expected.mean.head<2>(), R + expected.covariance.topLeftCorner<2, 2>());
  return {share * stands, (1 - share) * stands + astray,
          (1 - share) * moves + share * stands + astray};
}

}  // namespace

double log_mean(double a, double b) {
  return std::max(a, b) + std::log(0.5 * (1 + std::exp(-std::abs(a - b))));
}

double prior_log_odds(const TrackOptions& options) {
  return std::log(options.moving_prior / (1 - options.moving_prior));
}

double decayed(double log_odds, double dt, const TrackOptions& options) {
  const double prior = prior_log_odds(options);
  return prior + (log_odds - prior) * std::exp(-dt / options.memory_s);
}

ScanLesson learn_from_scans(const ObjectTrack& track, const ScanObject& object,
                            const TrackedScan& scan, const TrackOptions& options) {
  constexpr double kContradiction = 4.6;  // a hundred to one, of the free-space test
  constexpr double kWrong = 13.8;         // chi-square of two degrees of freedom, one in a thousand
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  ScanLesson lesson;
  lesson.from = options.image_factor ? track.latest : track.state;
  const TrackState expected = lesson.state = predicted(lesson.from, instant, options.noise);
  lesson.log_odds = decayed(options.image_factor ? track.latest_log_odds : track.log_odds,
                            seconds_between(track.stamp, instant), options);
  if (!options.scan_factor) return lesson;

  const TwoSights sights = two_sights(track, object, scan, expected);
  const auto registered = registered_step(sights.scans, scan.T_rest_lidar.linear());
  PlanarStep step = registered ? *registered : centroid_step(track, object, scan, options);
  if (registered && was_there_all_along(sights, step, scan)) lesson.log_odds -= kContradiction;
  const Eigen::Vector2d along = step.mean.head<2>();
  if (!tells_step(sights, along, scan))
    step.covariance.topLeftCorner<2, 2>() += along * along.transpose();
  // Ego-motion's error moves all that is measured from one scan to the other.
  step.covariance.topLeftCorner<2, 2>() += ego_error(scan, object.centroid);
  Likelihoods found = likelihoods(step, lesson.state, options);
  if (const TrackState* other = track.other_latest()) {
    const TrackState on_road = predicted(*other, instant, options.noise);
    const Likelihoods if_on_road = likelihoods(step, on_road, options);
    if (if_on_road.moving > found.moving) lesson.from = *other;
    if (if_on_road.moving > found.moving) lesson.state = on_road;
    found.moving = (found.moving + if_on_road.moving) / 2;
  }
  lesson.log_odds += std::log(found.moving / found.parked);
  lesson.log_odds = std::clamp(lesson.log_odds, -kMostLogOdds, kMostLogOdds);
  if (lesson.log_odds > 0 && 2 * found.stuck > found.moving) return lesson;
  const Eigen::Vector2d astray = (step.mean - lesson.state.mean.head<3>()).head<2>();
  const Eigen::Matrix2d S =
      (lesson.state.covariance.topLeftCorner<3, 3>() + step.covariance).topLeftCorner<2, 2>();
  lesson.surprises = astray.dot(S.inverse() * astray) > kWrong;
  if (lesson.surprises) lesson.from = new_track_state(track.stamp, options.noise);
  lesson.state = updated(predicted(lesson.from, instant, options.noise), step);
  return lesson;
}

}  // namespace lidar_upsampling
