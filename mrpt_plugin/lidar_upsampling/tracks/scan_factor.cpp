// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/scan_factor.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/tracks/centroid_step.h"
#include "lidar_upsampling/tracks/faces.h"
#include "lidar_upsampling/tracks/free_space.h"
#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/tracks/registered_step.h"

namespace lidar_upsampling {
namespace {

/// An object's sights in two scans.
struct TwoSights {
  ObjectScans scans;
  double dt;  ///< s
  Eigen::Matrix2d axes_before, axes_now;
  Faces faces_now;
};

TwoSights two_sights(const ObjectTrack& track, const Surface& surface, const TrackedScan& scan,
                     const TrackState& expected, const TrackOptions& options) {
  TwoSights sights{{*track.surface, surface},
                   seconds_between(track.stamp, expected.stamp),
                   level_axes(track.T_rest_lidar.linear()),
                   level_axes(scan.T_rest_lidar.linear()),
                   Faces(surface)};
  // Over ground, about the centroid, in the axes of the lidar frame then.
  Twist motion = Twist::Zero();
  motion[2] = expected.mean[2];
  motion.segment<2>(3) = sights.axes_before.transpose() * expected.mean.head<2>();
  sights.scans.T_lidar_k_lidar_before = scan.T_rest_lidar.inverse() * track.T_rest_lidar;
  sights.scans.T_mov_guess =
      motion_pose(motion, track.T_rest_lidar.inverse() * track.centroid_rest);
  sights.scans.turn_sigma_rad = options.noise.unknown_yaw_rate_sigma * sights.dt;
  sights.scans.points_per_observation = options.points.points_per_observation;
  if (track.seen) {
    sights.scans.seen_before = track.seen.get();
    sights.scans.seen_now = scan.seen.get();
  }
  return sights;
}

/// Whether what is seen of the object tells a step: by a face across it, or an end that both scans
/// show. Else its ends are the edges of what hides the rest of it, and their steps are not its own.
bool tells_step(const TwoSights& sights, const Eigen::Vector2d& step, const TrackedScan& scan) {
  constexpr double kFace = 0.1;  // of its surface: a face
  if (sights.scans.seen_before == nullptr || step.norm() < 1e-3) return true;
  const Eigen::Vector2d d = step.normalized();
  const ObjectSight before{sights.scans.before.points(), *sights.scans.seen_before};
  const ObjectSight now{sights.scans.now.points(), *scan.seen};
  const Eigen::Vector2d d_before = sights.axes_before.transpose() * d;
  const Eigen::Vector2d d_now = sights.axes_now.transpose() * d;
  return (ends_in_sight(before, d_before) && ends_in_sight(now, d_now)) ||
         (ends_in_sight(before, -d_before) && ends_in_sight(now, -d_now)) ||
         sights.faces_now.share_across(d_now) > kFace;
}

/// Where an object ends on one side.
struct End {
  double place;    ///< m along a direction at rest
  double spacing;  ///< m, to the next beams, between which it may end
};

/// None if something hides its end.
std::optional<End> end_of(const Surface& object, const SeenSpace& seen, const Pose& T_rest_lidar,
                          const Eigen::Vector2d& axes_ahead, const Eigen::Vector2d& ahead) {
  constexpr std::size_t kShare = 20;  // the outermost twentieth
  if (!ends_in_sight({object.points(), seen}, axes_ahead)) return {};
  std::vector<std::pair<double, int>> along;
  for (const Eigen::Vector3f& point : object.points())
    along.emplace_back(ahead.dot((T_rest_lidar * point.cast<double>()).head<2>()),
                       static_cast<int>(along.size()));
  const std::size_t count = 1 + along.size() / kShare;
  std::nth_element(along.begin(), along.begin() + static_cast<std::ptrdiff_t>(count - 1),
                   along.end(), std::greater<>());
  End end{0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    end.place += along[i].first / static_cast<double>(count);
    end.spacing += object.spacing(along[i].second) / static_cast<double>(count);
  }
  return end;
}

/// A flat side slides under registration; its ends tell how far it has gone.
/// @param longer m, by which one of the scans shows more of it: at either end, as likely.
void join_ends(const ObjectTrack& track, const TwoSights& sights, const TrackedScan& scan,
               double longer, PlanarStep& step) {
  constexpr double kEnd_m = 0.1;  // how well two scans show the same end
  if (sights.scans.seen_before == nullptr) return;
  const Eigen::Vector2d loosest =
      symmetric_eigen<2>(step.covariance.topLeftCorner<2, 2>()).vectors.col(1);
  for (const Eigen::Vector2d& ahead : {loosest, Eigen::Vector2d(-loosest)}) {
    const auto before = end_of(sights.scans.before, *sights.scans.seen_before, track.T_rest_lidar,
                               sights.axes_before.transpose() * ahead, ahead);
    const auto now = end_of(sights.scans.now, *scan.seen, scan.T_rest_lidar,
                            sights.axes_now.transpose() * ahead, ahead);
    if (!before || !now) continue;
    const double sq_sigma = kEnd_m * kEnd_m + longer * longer / 4 +
                            (before->spacing * before->spacing + now->spacing * now->spacing) / 12;
    const Eigen::Vector3d direction(ahead.x(), ahead.y(), 0);
    const Eigen::Vector3d gain =
        step.covariance * direction / (direction.dot(step.covariance * direction) + sq_sigma);
    step.mean += gain * (now->place - before->place - direction.dot(step.mean));
    step.covariance -= gain * direction.transpose() * step.covariance;
  }
}

/// Likelihoods of a step. A registration gone astray leads anywhere; or, of what moves, it sticks
/// to where that was, as views of what comes into sight look as if it stood; or, of what stands, it
/// locks to the beams, which go with us.
class StepLikelihoods {
 public:
  /// @param locked density of the step where it is locked.
  StepLikelihoods(const PlanarStep& step, double locked, const TrackOptions& options)
      : d_(step.mean.head<2>()),
        R_(step.covariance.topLeftCorner<2, 2>()),
        freedom_(step.degrees_of_freedom),
        share_(options.outlier_share),
        astray_(options.outlier_share * options.outlier_density),
        stands_(density(d_, kCreep_m * kCreep_m * Eigen::Matrix2d::Identity())),
        locked_(locked) {}

  [[nodiscard]] double parked() const {
    return (1 - share_) * stands_ + share_ * locked_ + astray_;
  }
  /// @param course at the second sight.
  [[nodiscard]] double moving(const TrackState& course) const {
    return (1 - share_) *
               density(d_ - course.mean.head<2>(), course.covariance.topLeftCorner<2, 2>()) +
           stuck() + astray_;
  }
  /// Of what moves, with a wrong registration.
  [[nodiscard]] double stuck() const { return share_ * stands_; }

 private:
  static constexpr double kCreep_m = 0.01;  // of what stands: points are this coarse

  [[nodiscard]] double density(const Eigen::Vector2d& astray,
                               const Eigen::Matrix2d& expected) const {
    return student_density(astray, R_ + expected, freedom_);
  }

  Eigen::Vector2d d_;
  Eigen::Matrix2d R_;
  double freedom_, share_, astray_, stands_, locked_;
};

/// What the scans tell of the step, the ego-motion's error included.
PlanarStep measured_step(const ObjectTrack& track, const ScanObject& object,
                         const TwoSights& sights, const TrackedScan& scan,
                         const TrackOptions& options) {
  std::optional<PlanarStep> registered;
  if (track.seen) registered = registered_step(sights.scans, scan.T_rest_lidar.linear());
  PlanarStep step =
      registered ? *registered : centroid_step(track, object, sights.scans.now, scan, options);
  join_ends(track, sights, scan, object.length - track.length, step);
  const Eigen::Vector2d along = step.mean.head<2>();
  if (!tells_step(sights, along, scan))
    step.covariance.topLeftCorner<2, 2>() += along * along.transpose();
  step.covariance.topLeftCorner<2, 2>() += ego_error(scan, object.centroid);
  return step;
}

/// Density of a step that keeps to the sensor, if the beams meet surfaces along it only.
/// @param faces of the object now.
double density_of_locked(const ObjectTrack& track, const Faces& faces, const PlanarStep& step,
                         const Pose& T_rest_lidar) {
  const Eigen::Vector3d with_us =
      T_rest_lidar * (track.T_rest_lidar.inverse() * track.centroid_rest) - track.centroid_rest;
  const double density =
      student_density(step.mean.head<2>() - with_us.head<2>(),
                      step.covariance.topLeftCorner<2, 2>(), step.degrees_of_freedom);
  const Eigen::Vector2d ahead = level_axes(T_rest_lidar.linear()).transpose() * with_us.head<2>();
  if (ahead.norm() < 1e-3) return density;
  return density * (1 - faces.share_across(ahead.normalized()));
}

/// Parked or moving, by the step, and on which course.
/// @return whether the step may be taken for its own.
bool judge_step(const ObjectTrack& track, const PlanarStep& step, double locked,
                const TrackOptions& options, ScanLesson& lesson) {
  const StepLikelihoods likelihood(step, locked, options);
  double moving = 0, best = 0;
  for (const Course& course : courses_of(track, options)) {
    const TrackState now = predicted(course.from, lesson.state.stamp, options.noise);
    const double here = course.probability * likelihood.moving(now);
    moving += here;
    if (here <= best) continue;
    best = here;
    lesson.from = course.from;
    lesson.surprises = course.is_new;
  }
  lesson.state = predicted(lesson.from, lesson.state.stamp, options.noise);
  lesson.log_odds = std::clamp(lesson.log_odds + std::log(moving / likelihood.parked()),
                               -kMostLogOdds, kMostLogOdds);
  return lesson.log_odds <= 0 || 2 * likelihood.stuck() <= moving;
}

}  // namespace

double log_ratio_of_class(const std::string& class_name) {
  constexpr double kPole = 0.1;  // it may be the edge of a truck that something hides
  return class_name == "pole" ? std::log(kPole) : 0;
}

double log_odds_at(Stamp instant, const std::string& class_then, const ObjectTrack& track,
                   double log_odds, const TrackOptions& options) {
  const auto prior_of = [&](const std::string& class_name) {
    return log_odds_of(options.moving_prior) + log_ratio_of_class(class_name);
  };
  const double dt = seconds_between(track.stamp, instant);
  return prior_of(class_then) +
         (log_odds - prior_of(track.class_name)) * std::exp(-dt / options.memory_s);
}

ScanLesson learn_from_scans(const ObjectTrack& track, const ScanObject& object,
                            const Surface& surface, const TrackedScan& scan,
                            const TrackOptions& options) {
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  ScanLesson lesson;
  lesson.from = options.image_factor ? track.latest : track.state;
  lesson.state = predicted(lesson.from, instant, options.noise);
  lesson.by_scans = predicted(track.by_scans, instant, options.noise);
  lesson.log_odds =
      log_odds_at(instant, object.class_name, track,
                  options.image_factor ? track.latest_log_odds : track.log_odds, options);
  if (!options.scan_factor) return lesson;
  const TwoSights sights = two_sights(track, surface, scan, lesson.state, options);
  const PlanarStep step = measured_step(track, object, sights, scan, options);
  const double locked = density_of_locked(track, sights.faces_now, step, scan.T_rest_lidar);
  if (judge_step(track, step, locked, options, lesson)) {
    if (lesson.surprises) lesson.by_scans = lesson.state;
    lesson.state = updated(lesson.state, step);
    lesson.by_scans = updated(lesson.by_scans, step);
  }
  return lesson;
}

}  // namespace lidar_upsampling
