// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/object_tracks.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr double kMostSure = 8;  // of log-odds: 1 in 3000 is as sure as such tests are

double log_density(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance) {
  return -0.5 * (astray.dot(covariance.ldlt().solve(astray)) + std::log(covariance.determinant())) -
         std::log(2 * M_PI);
}

/// Where a registration leads may be wrong.
double log_likelihood(const Eigen::Vector2d& astray, const Eigen::Matrix2d& covariance,
                      const TrackOptions& options) {
  return std::log((1 - options.outlier_share) * std::exp(log_density(astray, covariance)) +
                  options.outlier_share * options.outlier_density);
}

double prior_log_odds(const TrackOptions& options) {
  return std::log(options.moving_prior / (1 - options.moving_prior));
}

/// Its points' motion between two scans.
struct ScanFactor {
  bool is_measured = false;
  PlanarStep step;
  bool contradicts_motion = false;  ///< another scan saw it where it now is
};

Eigen::Matrix2d level(const Eigen::Matrix3d& R_rest_lidar) {
  return Eigen::Rotation2Dd(std::atan2(R_rest_lidar(1, 0), R_rest_lidar(0, 0))).toRotationMatrix();
}

ScanFactor register_object_scans(const ObjectTrack& track, const ScanObject& object,
                                 const TrackedScan& scan, const TrackState& expected) {
  ScanFactor factor;
  const Stamp instant = expected.stamp;
  const double dt = seconds_between(track.stamp, instant);
  const Pose T_k_before = scan.T_rest_lidar.inverse() * track.T_rest_lidar;
  ObjectScans scans{track.points, points_at(scan.scan, object.points), T_k_before,
                    Pose::Identity(), dt};
  // Over ground, about the centroid, in the axes of the lidar frame then.
  const Eigen::Matrix2d before = level(track.T_rest_lidar.linear());
  Twist motion = Twist::Zero();
  motion[2] = expected.mean[2];
  motion.segment<2>(3) = before.transpose() * expected.mean.head<2>();
  scans.T_mov_guess = motion_pose(motion, track.T_rest_lidar.inverse() * track.centroid_rest);
  const auto measured = measure_between_scans(scans, instant, scan.T_rest_lidar.linear());
  if (!measured) return factor;
  factor.is_measured = true;
  factor.step.mean << dt * measured->velocity_at_rest.head<2>(), dt * measured->yaw_rate;
  factor.step.covariance.topLeftCorner<2, 2>() = dt * dt * measured->velocity_covariance;
  constexpr double kYaw = 0.05;  // rad, of a registration's
  factor.step.covariance(2, 2) = kYaw * kYaw;

  if (scan.seen_before == nullptr ||
      std::abs(dt - seconds_between(scan.stamp_before, scan.scan.stamp)) > 0.5 * dt)
    return factor;
  const Eigen::Matrix2d now = level(scan.T_rest_lidar.linear());
  const Eigen::Vector2d step = factor.step.mean.head<2>();
  factor.contradicts_motion =
      was_there_then({scans.now, scan.seen, true}, now.transpose() * step, T_k_before.inverse(),
                     *scan.seen_before) &&
      was_there_then({track.points, *scan.seen_before, true}, -(before.transpose() * step),
                     T_k_before, scan.seen);
  return factor;
}

/// Where nothing can be registered, the centroid tells.
PlanarStep step_of_centroid(const ObjectTrack& track, const ScanObject& object,
                            const TrackedScan& scan, const TrackOptions& options) {
  PlanarStep step;
  step.mean.head<2>() = (scan.T_rest_lidar * object.centroid - track.centroid_rest).head<2>();
  const double sigma = 0.1 + options.extent_error * object.length;
  step.covariance.diagonal() << sigma * sigma, sigma * sigma, 1;
  return step;
}

/// What two scans tell: the state at the second one, and the log-odds of moving.
struct Learnt {
  TrackState state;
  double log_odds;
};

Learnt learn_from_scans(const ObjectTrack& track, const ScanObject& object, const TrackedScan& scan,
                        const TrackOptions& options) {
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  const double dt = seconds_between(track.stamp, instant);
  const TrackState expected = predicted(track.latest, instant, options.noise);
  const ScanFactor factor = register_object_scans(track, object, scan, expected);
  PlanarStep step = factor.is_measured ? factor.step : step_of_centroid(track, object, scan, options);
  // Ego-motion's error moves all that is measured from one scan to the other.
  Eigen::Matrix<double, 3, 6> by_twist;
  by_twist << -skew(object.centroid), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d ego = by_twist * scan.step_covariance * by_twist.transpose();
  step.covariance.topLeftCorner<2, 2>() += ego.topLeftCorner<2, 2>();

  const Eigen::Matrix2d R = step.covariance.topLeftCorner<2, 2>();
  const Eigen::Vector2d d = step.mean.head<2>();
  const Eigen::Vector2d astray = d - expected.mean.head<2>();
  const Eigen::Matrix2d S = expected.covariance.topLeftCorner<2, 2>() + R;
  constexpr double kCreep = 0.01;  // m, of what stands
  const double moving = log_likelihood(astray, S, options);
  const double parked = log_likelihood(d, R + kCreep * kCreep * Eigen::Matrix2d::Identity(), options);
  constexpr double kContradiction = 4.6;  // a hundred to one
  const double prior = prior_log_odds(options);
  double log_odds = prior + (track.latest_log_odds - prior) * std::exp(-dt / options.memory_s);
  log_odds += moving - parked - (factor.contradicts_motion ? kContradiction : 0);

  constexpr double kWrong = 13.8;  // chi-square of two degrees of freedom, one in a thousand
  const bool surprises = astray.dot(S.ldlt().solve(astray)) > kWrong;
  const TrackState base = !surprises ? expected
                                     : predicted(new_track_state(track.stamp, options.noise), instant,
                                                 options.noise);
  return {updated(base, step), std::clamp(log_odds, -kMostSure, kMostSure)};
}

/// Whether the covariance still says where to look.
bool is_lost(const ObjectTrack& track, Stamp now, const TrackOptions& options) {
  const double furthest = 0.4 * options.noise.unknown_speed_sigma;  // m: as after 0.4 s of an unknown one
  const TrackState state = predicted(track.latest, now, options.noise);
  return state.covariance.topLeftCorner<2, 2>().trace() > 2 * furthest * furthest;
}

}  // namespace

std::vector<int> take_up_scan(TrackStore& store, const std::vector<ScanObject>& objects,
                              const TrackedScan& scan, const TrackOptions& options) {
  auto& tracks = store.tracks;
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                              [&](const ObjectTrack& track) {
                                return is_lost(track, scan.scan.stamp, options);
                              }),
               tracks.end());
  std::vector<int> track_of = associate(tracks, objects, scan, options);
  const std::size_t old = tracks.size();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (track_of[i] >= 0) continue;
    track_of[i] = static_cast<int>(tracks.size());
    tracks.emplace_back().id = store.next_id++;
  }
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    ObjectTrack& track = tracks[track_of[i]];
    const ScanObject& object = objects[i];
    const Stamp instant = shifted(scan.scan.stamp, object.time_s);
    track.is_new = track_of[i] >= static_cast<int>(old);
    if (!track.is_new) {
      const Learnt learnt = learn_from_scans(track, object, scan, options);
      track.state = from_here(learnt.state);
      track.log_odds = learnt.log_odds;
    } else {
      track.state = new_track_state(instant, options.noise);
      track.log_odds = prior_log_odds(options);
    }
    track.ahead.reset();
    track.latest = track.state;
    track.latest_log_odds = track.log_odds;
    track.class_name = object.class_name;
    track.stamp = instant;
    track.T_rest_lidar = scan.T_rest_lidar;
    track.points = points_at(scan.scan, object.points);
    track.centroid_rest = scan.T_rest_lidar * object.centroid;
    track.size = static_cast<double>(object.points.size()) * object.centroid.squaredNorm();
  });
  return track_of;
}

void look_ahead(TrackStore& store, const std::vector<ScanObject>& objects, const TrackedScan& scan,
                const TrackOptions& options) {
  const std::vector<int> track_of = associate(store.tracks, objects, scan, options);
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    if (track_of[i] < 0) return;
    ObjectTrack& track = store.tracks[track_of[i]];
    const Learnt learnt = learn_from_scans(track, objects[i], scan, options);
    track.ahead = learnt.state;
    track.ahead_log_odds = learnt.log_odds;
  });
}

MotionExpected expected_motion(const TrackState& at_instant, const MotionQuestion& question,
                               double dt, const TrackOptions& options) {
  const Eigen::Matrix2d R = level(question.R_rest_lidar_k).transpose();
  const PlanarStep step = at_instant.step();
  MotionExpected expected;
  expected.mean[2] = step.mean[2];
  expected.mean.segment<2>(3) = R * step.mean.head<2>();
  const double tilt = (options.tilt_sigma_deg + options.tilt_rate_sigma_deg * dt) * kDegree;
  const double rise = options.height_sigma_m + options.height_rate_sigma * dt;
  Matrix6d& P = expected.covariance;
  P.setZero();
  P.diagonal() << tilt * tilt, tilt * tilt, step.covariance(2, 2), 0, 0, rise * rise;
  P.block<2, 2>(3, 3) = R * step.covariance.topLeftCorner<2, 2>() * R.transpose();
  P.block<2, 1>(3, 2) = R * step.covariance.block<2, 1>(0, 2);
  P.block<1, 2>(2, 3) = P.block<2, 1>(3, 2).transpose();
  return expected;
}

namespace {

/// Errors of the ego-motion and of the calibration, as a motion of the object; lidar frame at k.
Matrix6d common_error(const MotionQuestion& question, const TrackOptions& options) {
  const Eigen::Matrix3d R = question.T_lidar_t_lidar_k.linear().transpose();
  Matrix6d by_twist = Matrix6d::Zero();
  by_twist.topLeftCorner<3, 3>() = R;
  by_twist.bottomLeftCorner<3, 3>() = -R * skew(question.T_lidar_t_lidar_k * question.centroid);
  by_twist.bottomRightCorner<3, 3>() = R;
  Matrix6d error = by_twist * question.ego_covariance * by_twist.transpose();
  const double sideways =
      options.static_tolerance_px / question.focal_px * question.centroid.norm();
  constexpr double kLeastTurn = 2e-4;  // rad: keeps the covariance from being singular
  error.diagonal().head<3>().array() += kLeastTurn * kLeastTurn;
  error.diagonal().tail<3>().array() += sideways * sideways;
  return error;
}

}  // namespace

namespace {

PlanarStep in_rest(const Twist& mean, const Matrix6d& covariance, const Eigen::Matrix3d& R_rest_lidar_k) {
  Eigen::Matrix<double, 3, 6> pick = Eigen::Matrix<double, 3, 6>::Zero();
  pick.block<2, 2>(0, 3) = level(R_rest_lidar_k);
  pick(2, 2) = 1;
  return {pick * mean, pick * covariance * pick.transpose()};
}

void hear(MotionAnswer& answer, const ImageFactor& image, int num_followed,
          const MotionQuestion& question, const MotionExpected& moving, const MotionExpected& parked,
          std::vector<Twist> starts, const TrackState& before, const TrackOptions& options) {
  starts.push_back(moving.mean);
  MotionFit fit, stays;
  const auto fit_both = [&](double sigma_px) {
    fit = fit_motion(image, question.centroid, moving, starts, sigma_px, options.points);
    stays = fit_motion(image, question.centroid, parked, {Twist::Zero()}, sigma_px, options.points);
  };
  fit_both(options.points.sigma_px);
  const double sigma_px =
      measured_sigma_px(image, question.centroid, fit.cost < stays.cost ? fit.mean : stays.mean,
                        options.points);
  starts = {fit.mean};
  fit_both(sigma_px);
  const int agree = std::max(fit.num_inliers, stays.num_inliers);
  if (agree < options.min_agreement * static_cast<double>(image.observations.size()) ||
      agree < std::min<double>(options.min_inliers, 0.5 * num_followed))
    return;
  answer.is_seen = true;
  answer.fit = fit;
  answer.parked = stays;
  answer.log_odds += fit.log_evidence - stays.log_evidence;
  answer.state = updated(before, in_rest(moving.mean, moving.covariance, question.R_rest_lidar_k),
                         in_rest(fit.mean, fit.covariance, question.R_rest_lidar_k));
}

}  // namespace

MotionAnswer estimate_motion(const ObjectTrack& track, const ImageFactor& image,
                             int num_followed, const MotionQuestion& question, const std::vector<Twist>& starts,
                             const TrackOptions& options) {
  const double dt = seconds_between(track.stamp, question.instant);
  TrackState before = predicted(track.state, question.instant, options.noise);
  if (track.ahead) before = smoothed(before, *track.ahead, options.noise);
  const Matrix6d common = common_error(question, options);
  MotionExpected moving = expected_motion(before, question, dt, options);
  moving.covariance += common;
  MotionExpected parked;
  parked.covariance = common;

  MotionAnswer answer;
  answer.log_odds = track.ahead ? track.ahead_log_odds : track.log_odds;
  answer.state = before;
  answer.fit.mean = moving.mean;
  answer.fit.covariance = moving.covariance;
  if (!image.observations.empty()) hear(answer, image, num_followed, question, moving, parked, starts, before, options);
  answer.moves = answer.log_odds > std::log(options.loss_ratio);
  return answer;
}

}  // namespace lidar_upsampling
