// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/hypotheses.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/tracks/scan_factor.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

/// Errors of the ego-motion and of the calibration, as a motion of the object; lidar frame at k.
Matrix6d common_error(const MotionQuestion& question, const TrackOptions& options) {
  const Eigen::Matrix3d R = question.T_lidar_t_lidar_k.linear().transpose();
  Matrix6d by_twist = Matrix6d::Zero();
  by_twist.topLeftCorner<3, 3>() = R;
  by_twist.bottomLeftCorner<3, 3>() = -R * skew(question.T_lidar_t_lidar_k * question.centroid);
  by_twist.bottomRightCorner<3, 3>() = R;
  Matrix6d error = by_twist * question.ego_covariance * by_twist.transpose();
  const double sideways = options.common_error_px / question.focal_px * question.centroid.norm();
  constexpr double kLeastTurn = 2e-4;  // rad: a hundredth of a degree, so that it can be inverted
  error.diagonal().head<3>().array() += kLeastTurn * kLeastTurn;
  error.diagonal().tail<3>().array() += sideways * sideways;
  return error;
}

PlanarStep in_rest(const Twist& mean, const Matrix6d& covariance,
                   const Eigen::Matrix3d& R_rest_lidar_k) {
  Eigen::Matrix<double, 3, 6> pick = Eigen::Matrix<double, 3, 6>::Zero();
  pick.block<2, 2>(0, 3) = level_axes(R_rest_lidar_k);
  pick(2, 2) = 1;
  return {pick * mean, pick * covariance * pick.transpose()};
}

/// What either hypothesis expects, and who knows nothing.
struct Expected {
  MotionExpected moving, parked, any;
};

struct Fits {
  MotionFit moving, parked;
};

bool is_heard(const Fits& fits, std::size_t num_found, int num_followed,
              const TrackOptions& options) {
  const int agree = std::max(fits.moving.num_inliers, fits.parked.num_inliers);
  // Of few points, half are enough.
  return agree >= options.min_agreement * static_cast<double>(num_found) &&
         agree >= std::min<double>(options.min_inliers, 0.5 * num_followed);
}

/// What remains of a measurement that has joined `after` from `before`, joined with another guess.
PlanarStep joined(const PlanarStep& other, const PlanarStep& before, const PlanarStep& after) {
  const Eigen::Matrix3d of_other = other.covariance.inverse();
  const Eigen::Matrix3d of_before = before.covariance.inverse(),
                        of_after = after.covariance.inverse();
  PlanarStep result;
  result.covariance = (of_other + of_after - of_before).inverse();
  result.mean =
      result.covariance * (of_other * other.mean + of_after * after.mean - of_before * before.mean);
  return result;
}

/// The state with what the picture tells, whatever was expected of the picture.
TrackState learnt(const TrackState& state, const Expected& expected, const MotionFit& fit,
                  const Eigen::Matrix3d& R_rest_lidar_k) {
  const PlanarStep common =
      in_rest(expected.parked.mean, expected.parked.covariance, R_rest_lidar_k);
  PlanarStep own = state.step();
  own.covariance += common.covariance;
  const PlanarStep before =
      in_rest(expected.moving.mean, expected.moving.covariance, R_rest_lidar_k);
  return updated(state, own,
                 joined(own, before, in_rest(fit.mean, fit.covariance, R_rest_lidar_k)));
}

/// Of the picture, unless its points were found at wrong places, where they fit as well as ones of
/// which nothing is expected: `log_of_any`.
double log_likelihood(double log_evidence, double log_of_any, const TrackOptions& options) {
  const double most = std::max(log_evidence, log_of_any);
  return most + std::log((1 - options.outlier_share) * std::exp(log_evidence - most) +
                         options.outlier_share * std::exp(log_of_any - most));
}

void hear(MotionAnswer& answer, const ImageFactor& image, const MotionQuestion& question,
          const Expected& expected, std::vector<Twist> starts, const TrackOptions& options) {
  starts.push_back(expected.moving.mean);
  const auto fit = [&](const MotionExpected& prior, const std::vector<Twist>& from) {
    return fit_with_scatter(image, question.centroid, prior, from, options.points);
  };
  const Fits fits{fit(expected.moving, starts), fit(expected.parked, {Twist::Zero()})};
  if (!is_heard(fits, image.observations.size(), question.num_followed, options)) return;
  answer.is_seen = true;
  answer.moving = fits.moving;
  answer.parked = fits.parked;
  const double of_any = fit(expected.any, {fits.moving.mean}).log_evidence;
  const double parked = log_likelihood(fits.parked.log_evidence, of_any, options);
  answer.log_odds +=
      log_likelihood(log_likelihood(fits.moving.log_evidence, of_any, options), parked, options) -
      parked;
  answer.state = learnt(answer.state, expected, fits.moving, question.R_rest_lidar_k);
}

// How it may move, at the instant.
struct States {
  TrackState any;       // who knows nothing
  TrackState state;     // as the filter has it
  TrackState expected;  // with scans to come
};

MotionAnswer answer_from(const States& states, double log_odds, const ImageFactor& image,
                         const MotionQuestion& question, const std::vector<Twist>& starts,
                         double dt, const TrackOptions& options) {
  const auto motion = [&](const TrackState& state) {
    return expected_motion(state, question.R_rest_lidar_k, dt, options);
  };
  Expected expected{motion(states.expected), {}, motion(states.any)};
  expected.parked.covariance = common_error(question, options);
  expected.moving.covariance += expected.parked.covariance;
  expected.any.covariance += expected.parked.covariance;
  MotionAnswer answer;
  answer.state = states.state;
  answer.log_odds = log_odds;
  answer.moving.mean = expected.moving.mean;
  answer.moving.covariance = expected.moving.covariance;
  answer.parked.covariance = expected.parked.covariance;
  if (!image.observations.empty()) hear(answer, image, question, expected, starts, options);
  return answer;
}

}  // namespace

MotionExpected expected_motion(const TrackState& at_instant, const Eigen::Matrix3d& R_rest_lidar_k,
                               double dt, const TrackOptions& options) {
  constexpr double kAnyTilt = 0.5, kAnyRise_m = 5;  // rad, m: no opinion
  const Eigen::Matrix2d R = level_axes(R_rest_lidar_k).transpose();
  const PlanarStep step = at_instant.step();
  MotionExpected expected;
  expected.mean[2] = step.mean[2];
  expected.mean.segment<2>(3) = R * step.mean.head<2>();
  const double tilt =
      options.ground_factor
          ? (options.tilt_sigma_deg + options.tilt_rate_sigma_deg * std::abs(dt)) * kDegree
          : kAnyTilt;
  const double rise = options.ground_factor
                          ? options.height_sigma_m + options.height_rate_sigma * std::abs(dt)
                          : kAnyRise_m;
  Matrix6d& P = expected.covariance;
  P.setZero();
  P.diagonal() << tilt * tilt, tilt * tilt, step.covariance(2, 2), 0, 0, rise * rise;
  P.block<2, 2>(3, 3) = R * step.covariance.topLeftCorner<2, 2>() * R.transpose();
  P.block<2, 1>(3, 2) = R * step.covariance.block<2, 1>(0, 2);
  P.block<1, 2>(2, 3) = P.block<2, 1>(3, 2).transpose();
  return expected;
}

MotionAnswer estimate_motion(const ObjectTrack& track, const ImageFactor& image,
                             const MotionQuestion& question, const std::vector<Twist>& starts,
                             const TrackOptions& options) {
  const auto at_instant = [&](const TrackState& state) {
    return predicted(state, question.instant, options.noise);
  };
  const double dt = seconds_between(track.stamp, question.instant);
  const auto answer_if = [&](const TrackState& state, const TrackState& expected) {
    return answer_from({at_instant(new_track_state(track.stamp, options.noise)), state, expected},
                       track.expected_log_odds(), image, question, starts, dt, options);
  };
  const TrackState state = at_instant(track.state);
  MotionAnswer answer =
      answer_if(state, track.ahead ? track.expected_at(question.instant, options.noise) : state);
  if (answer.is_seen && track.on_road && !track.ahead) {
    const TrackState on_road = at_instant(*track.on_road);
    const MotionAnswer other = answer_if(on_road, on_road);
    const double log_odds = log_mean(answer.log_odds, other.log_odds);
    if (other.log_odds > answer.log_odds) answer = other;
    answer.log_odds = log_odds;
  }
  answer.moves = options.static_test ? answer.log_odds > std::log(options.loss_ratio)
                                     : answer.is_seen || answer.log_odds > 0;
  answer.log_odds = std::clamp(answer.log_odds, -kMostLogOdds, kMostLogOdds);
  return answer;
}

}  // namespace lidar_upsampling
