// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/object_registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lidar_upsampling/registration/object_fit.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {

namespace {

constexpr double kResidualSigma =
    0.03;  // m, of a good match: what the soft constraints weigh against

using Points = std::vector<Eigen::Vector3f>;

struct Candidate {
  Pose T = Pose::Identity();
  double score = kScoreCut;
  double rank = kScoreCut;  ///< the score, with what an unexpected place adds
};

Points thinned(const Points& points, int max_points) {
  const auto limit = static_cast<std::size_t>(max_points);
  if (points.size() <= limit) {
    return points;
  }
  Points kept;
  kept.reserve(limit);
  for (std::size_t i = 0; i < limit; ++i) {
    kept.push_back(points[i * points.size() / limit]);
  }
  return kept;
}

/// Adds one point's match: across the surface with full weight, along it with little.
void add_match(const ObjectFit& problem, const Eigen::Vector3d& point, const Eigen::Vector3d& pivot,
               double scale, Matrix6d& H, Twist& b) {
  const double reach = problem.options.max_correspondence_m;
  const auto nearest =
      problem.target.nearest(point.cast<float>(), static_cast<float>(reach * reach));
  if (nearest.index < 0) {
    return;
  }
  const Eigen::Vector3d error = point - problem.target.points()[nearest.index].cast<double>();
  const Eigen::Vector3d normal = problem.target.normal(nearest.index).cast<double>();
  const double along = normal.isZero() ? 1 : problem.options.point_weight;
  const Eigen::Matrix3d metric =
      along * Eigen::Matrix3d::Identity() + (1 - along) * normal * normal.transpose();
  const double root = scale * scale / (scale * scale + error.dot(metric * error));
  // J = [-S, I] with S = [point - pivot]x; only the lower triangle of H = J' W J is read.
  const Eigen::Matrix3d weighted = root * root * metric;
  const Eigen::Matrix3d S = skew(point - pivot);
  const Eigen::Matrix3d turned = weighted * S;
  const Eigen::Vector3d pull = weighted * error;
  H.topLeftCorner<3, 3>().noalias() += S.transpose() * turned;
  H.bottomLeftCorner<3, 3>() -= turned;
  H.bottomRightCorner<3, 3>() += weighted;
  b.head<3>() -= (point - pivot).cross(pull);
  b.tail<3>() -= pull;
}

/// Vehicles stay level with the ground: soft, or sparse rings would tilt them.
void add_level(const ObjectFit& problem, const Pose& T, Matrix6d& H, Twist& b) {
  const Eigen::AngleAxisd turned(T.linear() * problem.T_level.linear().transpose());
  const Eigen::Vector3d tilt = turned.angle() * turned.axis();
  const double rise = (T * problem.centroid - problem.T_level * problem.centroid).z();
  const int weigh_as = problem.options.weigh_as;
  const double crowd =
      weigh_as > 0 ? std::max(1., static_cast<double>(problem.points.size()) / weigh_as) : 1;
  const auto weight = [&](double sigma) { return crowd * std::pow(kResidualSigma / sigma, 2); };
  const double tilt_weight = weight(problem.options.tilt_sigma_rad);
  for (int axis = 0; axis < 2; ++axis) {
    H(axis, axis) += tilt_weight;
    b[axis] -= tilt_weight * tilt[axis];
  }
  H(5, 5) += weight(problem.options.height_sigma_m);
  b[5] -= weight(problem.options.height_sigma_m) * rise;
}

/// @param stop a step this short ends the search, m and rad
Candidate converge(const ObjectFit& problem, const Pose& guess, double stop = 2e-4) {
  Pose T = guess;
  double scale = 4 * problem.options.kernel_m;
  for (int i = 0; i < problem.options.max_iterations; ++i) {
    Matrix6d H = 1e-9 * Matrix6d::Identity();
    Twist b = Twist::Zero();
    const Eigen::Vector3d pivot = T * problem.centroid;
    for (const auto& point : problem.points) {
      const Eigen::Vector3d place = T * point.cast<double>();
      if (sight_in(problem, place.cast<float>()) == Sight::hidden) continue;
      add_match(problem, place, pivot, scale, H, b);
    }
    add_level(problem, T, H, b);
    const Twist step = H.ldlt().solve(b);
    if (!step.allFinite()) {
      break;
    }
    T = renormalized(Eigen::Translation3d(pivot) * exp_se3(step) * Eigen::Translation3d(-pivot) *
                     T);
    if (scale <= problem.options.kernel_m && step.norm() < stop) {
      break;
    }
    scale = std::max(problem.options.kernel_m, 0.75 * scale);
  }
  const double score = score_of(problem, T);
  return {T, score, rank_of(problem, T, score)};
}

Pose shifted_by(const Pose& T, double x, double y) { return Eigen::Translation3d(x, y, 0) * T; }

/// The best start on a half-metre grid around the ego-motion.
Candidate search_start(const ObjectFit& problem) {
  constexpr double kCell = 0.5;
  const int reach = static_cast<int>(problem.options.search_m / kCell);
  const int stride = std::max(1, static_cast<int>(problem.points.size()) / 60);
  Candidate best;
  for (int ix = -reach; ix <= reach; ++ix) {
    for (int iy = -reach; iy <= reach; ++iy) {
      const Pose start = shifted_by(problem.T_level, ix * kCell, iy * kCell);
      const double score = score_of(problem, start, stride);
      if (score < best.score) {
        best = {start, score, score};
      }
    }
  }
  return best;
}

Candidate best_candidate(const ObjectFit& problem, const std::vector<Pose>& guesses) {
  Candidate best;
  if (problem.clues.expected != nullptr) best.rank = std::numeric_limits<double>::infinity();
  for (const Pose& guess : guesses) {
    if (&guess != &guesses.front() && guess.isApprox(guesses.front(), 1e-9)) continue;
    const Candidate candidate = converge(problem, guess);
    if (candidate.rank < best.rank) {
      best = candidate;
    }
  }
  if (problem.options.search_m <= 0) return best;
  // A far-off start may land on a neighbour that looks alike: it must be clearly better.
  const Candidate searched = converge(problem, search_start(problem).T);
  return searched.rank < 0.8 * best.rank ? searched : best;
}

struct Ambiguity {
  double spread = 0;
  Eigen::Matrix2d slack = Eigen::Matrix2d::Zero();
};

/// Whether the object may as well be out of the target's sight there: all of it is hidden, and what
/// it was matched to need not be its own, as it would not have been seen from where the object was.
bool may_hide_at(const ObjectFit& problem, const Pose& T, const Candidate& best) {
  constexpr double kMost = 0.9, kFew = 0.3;
  if (problem.clues.seen_with_object == nullptr) return false;
  const Eigen::Isometry3f T_target_object = T.cast<float>(), back = T_target_object.inverse();
  const auto num_points = static_cast<double>(problem.points.size());
  int hidden = 0, unexplained = 0;
  for (const auto& point : problem.points) {
    hidden += sight_in(problem, T_target_object * point) == Sight::hidden ? 1 : 0;
  }
  if (hidden < kMost * num_points) return false;
  for (const auto& point : problem.points) {
    const auto match = problem.target.nearest(best.T.cast<float>() * point);
    const Eigen::Vector3f then = back * problem.target.points()[match.index];
    unexplained += problem.clues.seen_with_object->at(then) == Sight::seen_through ? 1 : 0;
  }
  return unexplained < kFew * num_points;
}

/// How far a centroid went astray of a start, as a deviation.
Eigen::Vector2d deviation_of(const Eigen::Vector2d& astray, double shift_m) {
  return astray / std::max(0.1, 1 - astray.norm() / shift_m);
}

/// A start that comes back part of the way speaks of a weak pull there, one that stays of none.
/// Points lock into one another's pattern: the start is more than half a step of it away, and
/// within a step they may lie anyhow. What has gone out of sight cannot come back.
Ambiguity ambiguity_of(const ObjectFit& problem, const Candidate& best) {
  constexpr double kShift = 0.2;
  const Sampling sampling = sampling_under(problem, best.T);
  const double shift_m = std::clamp(0.6 * sampling.spacing_m, kShift, problem.options.max_shift_m);
  const double stop = 0.01 * shift_m;  // finer would tell nothing of who comes back
  const std::array<std::array<double, 2>, 4> shifts{
      {{shift_m, 0}, {-shift_m, 0}, {0, shift_m}, {0, -shift_m}}};
  Ambiguity result;
  for (const auto& shift : shifts) {
    const Pose start = shifted_by(best.T, shift[0], shift[1]);
    const Pose further = shifted_by(start, shift[0], shift[1]);  // shadows' borders are not sharp
    Eigen::Vector2d astray(shift[0], shift[1]);
    if (!may_hide_at(problem, start, best) && !may_hide_at(problem, further, best)) {
      const Candidate again = converge(problem, start, stop);
      if (again.score >= 1.15 * best.score + 0.005) continue;
      astray = (again.T * problem.centroid - best.T * problem.centroid).head<2>();
    }
    result.spread = std::max(result.spread, astray.norm());
    const Eigen::Vector2d deviation = deviation_of(astray, shift_m);
    result.slack += 0.5 * deviation * deviation.transpose();  // every axis is tried both ways
  }
  const double sq_phase = sampling.spacing_m * sampling.spacing_m / 12;
  if (std::isfinite(sq_phase)) result.slack += sq_phase * sampling.pull * sampling.pull.transpose();
  return result;
}

}  // namespace

ObjectRegistrationOptions options_between_scans(int max_points, int max_iterations,
                                                double search_m) {
  ObjectRegistrationOptions options;
  options.min_points = 10;
  options.max_shift_m = 0.6;
  options.weigh_as = 10;
  options.max_points = max_points;
  options.max_iterations = max_iterations;
  options.search_m = search_m;
  return options;
}

const char* to_string(RegistrationStatus status) {
  switch (status) {
    case RegistrationStatus::reliable:
      return "reliable";
    case RegistrationStatus::too_few_points:
      return "too_few_points";
    case RegistrationStatus::poor_overlap:
      return "poor_overlap";
    case RegistrationStatus::ambiguous:
      return "ambiguous";
  }
  return "unknown";
}

ObjectRegistration register_object(const Points& points_object, const Surface& target,
                                   const std::vector<Pose>& guesses,
                                   const ObjectRegistrationOptions& options,
                                   const RegistrationClues& clues) {
  if (guesses.empty()) {
    throw std::invalid_argument("register_object: needs at least one guess, the ego-motion");
  }
  ObjectRegistration result;
  result.T_target_object = guesses.front();
  if (static_cast<int>(points_object.size()) < options.min_points || target.points().empty()) {
    return result;
  }
  const Points points = thinned(points_object, options.max_points);
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const auto& point : points) {
    centroid += point.cast<double>() / static_cast<double>(points.size());
  }
  const ObjectFit problem{points, target, guesses.front(), options, centroid, clues};
  const Candidate best = best_candidate(problem, guesses);
  result.T_target_object = best.T;
  result.score_m = best.score;
  result.overlap = overlap_of(problem, best.T);
  if (result.overlap < options.min_overlap) {
    result.status = RegistrationStatus::poor_overlap;
    return result;
  }
  result.residual_m = residual_of(problem, best.T);
  const Ambiguity ambiguity = ambiguity_of(problem, best);
  result.spread_m = ambiguity.spread;
  result.slack = ambiguity.slack;
  result.status = result.spread_m > options.max_spread_m ? RegistrationStatus::ambiguous
                                                         : RegistrationStatus::reliable;
  return result;
}

}  // namespace lidar_upsampling
