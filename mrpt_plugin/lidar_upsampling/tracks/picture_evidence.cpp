// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/picture_evidence.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/tracks/log_odds.h"

namespace lidar_upsampling {
namespace {

double log_sum(const std::vector<double>& logs) {
  const double most = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (const double log : logs) sum += std::exp(log - most);
  return most + std::log(sum);
}

/// How many observations agree with a hypothesis, and how many followed ones do not.
struct Agreement {
  double agree = 0, lost = 0;
};

/// Those of which the motion has been made agree anyway: half as many as there are parameters that
/// they determine rather than what was expected (MacKay, Neural Computation 4, 1992).
Agreement agreement(const MotionFit& fit, const MotionExpected& expected, int num_followed,
                    const TrackOptions& options) {
  const double share = 1 / options.points.points_per_observation;
  const double num_fitted =
      6 - inverse(expected.covariance).cwiseProduct(fit.covariance).sum();  // the product's trace
  return {std::max(0., share * fit.num_inliers - num_fitted / 2),
          share * std::max(0, num_followed - fit.num_inliers)};
}

/// Log-odds that the points were found at wrong places: where they are looked for rightly, the most
/// of them are found again and agree (a share as Beta(2, 1)), elsewhere few (as Beta(1, 2)).
double log_odds_of_wrong(const Agreement& most, const TrackOptions& options) {
  return log_odds_of(options.outlier_share) + std::log((most.lost + 1) / (most.agree + 1));
}

/// Points at wrong places are anywhere, or on what stands behind a mover.
/// @param of_any log-evidence if nothing is expected of them.
void weigh(const std::vector<Way>& ways, double of_any, double odds_of_wrong,
           PictureEvidence& evidence) {
  const double log_right = -std::log1p(std::exp(odds_of_wrong));
  const double log_wrong = log_right + odds_of_wrong;
  evidence.log_parked = log_sum({evidence.parked.log_evidence + log_right, of_any + log_wrong});
  std::vector<double> logs;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double of_way = std::log(ways[i].probability);
    logs.push_back(of_way + evidence.moving[i].log_evidence + log_right);
    logs.push_back(of_way + of_any + log_wrong);
  }
  const double log_all = log_sum(logs);
  evidence.log_moving = log_sum({log_all, evidence.parked.log_evidence + log_wrong});
  for (std::size_t i = 0; i < ways.size(); ++i) {
    evidence.right.push_back(std::exp(logs[2 * i] - log_all));
    evidence.wrong.push_back(std::exp(logs[2 * i + 1] - log_all));
  }
}

}  // namespace

MotionFit fit_of_any(const ObjectTrack& track, const ImageFactor& image,
                     const MotionQuestion& question, const Matrix6d& of_ego,
                     std::vector<Twist> starts, const TrackOptions& options) {
  const auto expected_of = [&](const TrackState& now) {
    return expected_motion(now, question.R_rest_lidar_k,
                           seconds_between(track.stamp, question.instant), options);
  };
  starts.push_back(expected_of(track.expected_at(question.instant, options.noise)).mean);
  MotionExpected any = expected_of(
      predicted(new_track_state(track.stamp, options.noise), question.instant, options.noise));
  any.covariance += of_ego;
  return fit_with_scatter(image, question.centroid, any, starts, options.points);
}

PictureEvidence evidence_of_picture(const ImageFactor& image, const MotionQuestion& question,
                                    const std::vector<Way>& ways, const MotionExpected& parked,
                                    const MotionFit& of_any, const std::vector<Twist>& starts,
                                    const TrackOptions& options) {
  const auto fit = [&](const MotionExpected& prior, const std::vector<Twist>& from) {
    return fit_with_scatter(image, question.centroid, prior, from, options.points);
  };
  PictureEvidence evidence;
  evidence.parked = fit(parked, {Twist::Zero()});
  Agreement most = agreement(evidence.parked, parked, question.num_followed, options);
  for (const Way& way : ways) {
    std::vector<Twist> from = starts;
    from.push_back(way.expected.mean);
    evidence.moving.push_back(fit(way.expected, from));
    const Agreement now =
        agreement(evidence.moving.back(), way.expected, question.num_followed, options);
    if (now.agree > most.agree) most = now;
  }
  weigh(ways, of_any.log_evidence, log_odds_of_wrong(most, options), evidence);
  return evidence;
}

}  // namespace lidar_upsampling
