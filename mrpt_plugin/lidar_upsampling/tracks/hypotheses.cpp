// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/hypotheses.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/tracks/common_errors.h"
#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/tracks/picture_evidence.h"
#include "lidar_upsampling/tracks/scan_factor.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

PlanarStep in_rest(const Twist& mean, const Matrix6d& covariance,
                   const Eigen::Matrix3d& R_rest_lidar_k) {
  Eigen::Matrix<double, 3, 6> pick = Eigen::Matrix<double, 3, 6>::Zero();
  pick.block<2, 2>(0, 3) = level_axes(R_rest_lidar_k);
  pick(2, 2) = 1;
  return {pick * mean, pick * covariance * pick.transpose()};
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
TrackState learnt(const TrackState& state, const MotionExpected& expected,
                  const MotionExpected& parked, const MotionFit& fit,
                  const Eigen::Matrix3d& R_rest_lidar_k) {
  const auto step_of = [&](const auto& motion) {
    return in_rest(motion.mean, motion.covariance, R_rest_lidar_k);
  };
  PlanarStep own = state.step();
  own.covariance += step_of(parked).covariance;
  return updated(state, own, joined(own, step_of(expected), step_of(fit)));
}

std::vector<Way> ways_of(const ObjectTrack& track, const MotionQuestion& question,
                         const Matrix6d& common, const TrackOptions& options) {
  const auto way = [&](double probability, const TrackState& state, const TrackState& expected) {
    Way result{probability, state,
               expected_motion(expected, question.R_rest_lidar_k,
                               seconds_between(track.stamp, question.instant), options)};
    result.expected.covariance += common;
    return result;
  };
  const auto at_instant = [&](const TrackState& state) {
    return predicted(state, question.instant, options.noise);
  };
  if (track.ahead)
    return {way(1, at_instant(track.state), track.expected_at(question.instant, options.noise))};
  std::vector<Way> ways;
  double share = 1;
  if (is_told_by_picture(track, options)) {
    share = options.outlier_share;  // else an earlier picture was wrong
    const TrackState now = at_instant(track.latest);
    ways.push_back(way(1 - share, now, now));
    ways.back().is_told = true;
  }
  for (const Course& course : courses_before_images(track, question.ego_velocity, options.noise)) {
    const TrackState now = at_instant(course.from);
    ways.push_back(way(share * course.probability, now, now));
  }
  return ways;
}

/// The mixture of some Gaussians as one, with the same mean and covariance.
template <typename Gaussian>
void mix(const std::vector<double>& weights, const std::vector<Gaussian>& parts, Gaussian& mixed) {
  mixed.mean.setZero();
  mixed.covariance.setZero();
  for (std::size_t i = 0; i < parts.size(); ++i) mixed.mean += weights[i] * parts[i].mean;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto astray = (parts[i].mean - mixed.mean).eval();
    mixed.covariance += weights[i] * (parts[i].covariance + astray * astray.transpose());
  }
}

/// What the picture's own error leaves of a fit that holds it.
MotionFit without(const Matrix6d& error, const MotionExpected& expected, MotionFit fit) {
  const Matrix6d K = Matrix6d::Identity() - error * inverse(expected.covariance);
  fit.mean = expected.mean + K * (fit.mean - expected.mean);
  fit.covariance = Matrix6d(K * fit.covariance * K.transpose() + K * error);
  return fit;
}

/// The mixture of all that was expected before any picture, each with a right and with a wrong one:
/// pictures since the last sight follow the same points, so that the same is wrong in all of them.
TrackState state_by_picture(const PictureEvidence& evidence, const std::vector<Way>& ways,
                            const MotionExpected& parked, const Eigen::Matrix3d& R_rest_lidar_k) {
  std::vector<TrackState> states;
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (ways[i].is_told) continue;
    weights.insert(weights.end(), {evidence.right[i], evidence.wrong[i]});
    states.push_back(
        learnt(ways[i].state, ways[i].expected, parked, evidence.moving[i], R_rest_lidar_k));
    states.push_back(ways[i].state);
    sum += evidence.right[i] + evidence.wrong[i];
  }
  for (double& weight : weights) weight /= sum;
  TrackState state = states.front();
  mix(weights, states, state);
  return state;
}

/// The mixture of all ways, each with a right and with a wrong picture.
void learn(const PictureEvidence& evidence, const std::vector<Way>& ways,
           const MotionExpected& parked, const Matrix6d& of_picture, const MotionQuestion& question,
           MotionAnswer& answer) {
  std::vector<MotionFit> told;
  std::vector<double> weights;
  double wrong = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    weights.push_back(evidence.right[i]);
    told.push_back(without(of_picture, ways[i].expected, evidence.moving[i]));
    weights.push_back(evidence.wrong[i]);
    told.push_back(told.back());
    told.back().mean = ways[i].expected.mean;
    told.back().covariance = ways[i].expected.covariance;
    wrong += evidence.wrong[i];
  }
  answer.is_seen = wrong < 0.5;
  answer.parked = evidence.parked;
  answer.moving = evidence.moving[std::max_element(evidence.right.begin(), evidence.right.end()) -
                                  evidence.right.begin()];
  mix(weights, told, answer.moving);
  answer.state = state_by_picture(evidence, ways, parked, question.R_rest_lidar_k);
  answer.log_ratio = evidence.log_moving - evidence.log_parked;
  answer.log_odds += answer.log_ratio;
}

/// The motion as one of the ways has it, without the picture.
void take(const Way& way, MotionAnswer& answer) {
  answer.state = way.state;
  answer.moving.mean = way.expected.mean;
  answer.moving.covariance = way.expected.covariance;
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
  const double grown = 1 + std::abs(dt) / options.ground_time_s;
  const double tilt = options.ground_factor ? options.tilt_sigma_deg * grown * kDegree : kAnyTilt;
  const double rise = options.ground_factor ? options.height_sigma_m * grown : kAnyRise_m;
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
  constexpr double kLeastTurn = 2e-4;  // rad: a hundredth of a degree, so that it can be inverted
  MotionExpected parked{Twist::Zero(), ego_error(question)};
  parked.covariance.diagonal().array() += kLeastTurn * kLeastTurn;
  const bool is_shown = !image.observations.empty();
  Matrix6d of_picture = Matrix6d::Zero();
  MotionFit of_any;
  if (is_shown) {
    of_any = fit_of_any(track, image, question, parked.covariance, starts, options);
    of_picture = picture_error(question, image, of_any.sigma_px, options);
  }
  parked.covariance += of_picture;
  const std::vector<Way> ways = ways_of(track, question, parked.covariance, options);
  MotionAnswer answer;
  answer.log_odds = track.expected_log_odds();
  take(ways.front(), answer);
  answer.parked.covariance = parked.covariance;
  if (is_shown)
    learn(evidence_of_picture(image, question, ways, parked, of_any, starts, options), ways, parked,
          of_picture, question, answer);
  if (!answer.is_seen && ways.front().is_told) {
    take(ways.front(), answer);
    answer.log_odds = track.latest_log_odds;
  }
  answer.moves = options.static_test ? answer.log_odds > std::log(options.loss_ratio)
                                     : answer.is_seen || answer.log_odds > 0;
  answer.log_odds = std::clamp(answer.log_odds, -kMostLogOdds, kMostLogOdds);
  return answer;
}

void note_answer(ObjectTrack& track, const MotionAnswer& answer, const MotionNoise& noise) {
  if (!answer.is_seen) return;
  if (!answer.moves && answer.log_odds <= -kMostLogOdds && answer.log_ratio <= 0)
    track.settled = std::make_shared<const MotionAnswer>(answer);
  const auto doubt = [](const TrackState& state) {
    return state.covariance.block<2, 2>(3, 3).trace();
  };
  const TrackState& now = answer.state;
  if (track.latest.stamp == track.stamp ||
      doubt(now) < doubt(predicted(track.latest, now.stamp, noise)))
    track.latest = now;
  track.latest_log_odds =
      std::clamp(track.log_odds + answer.log_ratio, -kMostLogOdds, kMostLogOdds);
}

}  // namespace lidar_upsampling
