// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/object_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lidar_upsampling/registration/ambiguity.h"

namespace lidar_upsampling {

namespace {

using Points = std::vector<Eigen::Vector3f>;

/// The best start on a half-metre grid around the ego-motion.
Fitted search_start(const ObjectFit& problem) {
  constexpr double kCell = 0.5;
  const int reach = static_cast<int>(problem.options.search_m / kCell);
  const int stride = std::max(1, static_cast<int>(problem.points.size()) / 60);
  Fitted best;
  for (int ix = -reach; ix <= reach; ++ix) {
    for (int iy = -reach; iy <= reach; ++iy) {
      const Pose start = shifted_by(problem.T_level, ix * kCell, iy * kCell);
      const double score = score_of(problem, start, stride, best.score);
      if (score < best.score) {
        best = {start, score, score};
      }
    }
  }
  return best;
}

Fitted best_fit(const ObjectFit& problem, const std::vector<Pose>& guesses) {
  Fitted best;
  if (problem.clues.expected != nullptr) best.rank = std::numeric_limits<double>::infinity();
  for (const Pose& guess : guesses) {
    if (&guess != &guesses.front() && guess.isApprox(guesses.front(), 1e-9)) continue;
    const Fitted fitted = converge(problem, guess);
    if (fitted.rank < best.rank) {
      best = fitted;
    }
  }
  if (problem.options.search_m <= 0) return best;
  const Pose start = search_start(problem).T;
  if (start.isApprox(guesses.front(), 1e-9)) return best;  // has been gone from already
  // A far-off start may land on a neighbour that looks alike: it must be clearly better.
  const Fitted searched = converge(problem, start);
  return searched.rank < 0.8 * best.rank ? searched : best;
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
  const Points points = evenly_thinned(points_object, static_cast<std::size_t>(options.max_points));
  const ObjectFit problem{points, target, guesses.front(), options, mean_of(points), clues};
  const Fitted best = best_fit(problem, guesses);
  result.T_target_object = best.T;
  result.score_m = best.score;
  result.overlap = overlap_of(problem, best.T);
  if (result.overlap < options.min_overlap) {
    result.status = RegistrationStatus::poor_overlap;
    return result;
  }
  result.residual_m = residual_of(problem, best.T);
  const Ambiguity ambiguity = ambiguity_of(problem, best);
  result.spread_m = ambiguity.spread_m;
  result.slack = ambiguity.slack;
  result.status = result.spread_m > options.max_spread_m ? RegistrationStatus::ambiguous
                                                         : RegistrationStatus::reliable;
  return result;
}

}  // namespace lidar_upsampling
