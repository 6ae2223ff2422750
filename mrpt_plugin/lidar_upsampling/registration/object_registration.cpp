// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/object_registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "lidar_upsampling/registration/object_fit.h"

namespace lidar_upsampling {
namespace {

/// How far an object may lie from where it was fitted, for all that its points and the target tell.
struct Ambiguity {
  double spread_m = 0;  ///< how far shifted starts go astray and fit as well
  Eigen::Matrix2d slack = Eigen::Matrix2d::Zero();  ///< m^2, level covariance told by them
};

constexpr double kSettled = 2e-4, kGoodStart = 1e-3;  // m and rad: steps that end a search

Pose shifted_by(const Pose& T, double x, double y) { return Eigen::Translation3d(x, y, 0) * T; }

/// How far a centroid went astray of a start, as a deviation.
Eigen::Vector2d deviation_of(const Eigen::Vector2d& astray, double shift_m) {
  return astray / std::max(0.1, 1 - astray.norm() / shift_m);
}

/// Fits the object again from starts beside the answer, where it is held least. One that comes back
/// part of the way speaks of a weak pull there, one that stays of none, however well it fits.
/// Points lock into one another's pattern: starts are more than half a step of it away, and within
/// a step they may lie anyhow.
Ambiguity ambiguity_of(const ObjectFit& problem, const Fitted& best) {
  constexpr double kShift_m = 0.2;                   // m: more than noise carries a fit
  constexpr double kWorse = 1.15, kNoise_m = 0.005;  // times and more: who fits as well
  const Sampling sampling = sampling_under(problem, best.T);
  const double shift_m =
      std::clamp(0.6 * sampling.spacing_m, kShift_m, problem.options.max_shift_m);
  const double stop = 0.01 * shift_m;  // finer would tell nothing of who comes back
  Ambiguity result;
  for (const double side : {shift_m, -shift_m}) {
    Eigen::Vector2d astray = side * sampling.loosest;
    const Fitted again = converge(problem, shifted_by(best.T, astray.x(), astray.y()), stop);
    astray = (again.T * problem.centroid - best.T * problem.centroid).head<2>();
    if (again.score < kWorse * best.score + kNoise_m)
      result.spread_m = std::max(result.spread_m, astray.norm());
    const Eigen::Vector2d deviation = deviation_of(astray, shift_m);
    result.slack += 0.5 * deviation * deviation.transpose();  // it is tried both ways
  }
  const double sq_phase = sampling.spacing_m * sampling.spacing_m / 12;
  if (std::isfinite(sq_phase)) result.slack += sq_phase * sampling.pull * sampling.pull.transpose();
  return result;
}

using Points = std::vector<Eigen::Vector3f>;

/// The best start on a half-metre grid around the ego-motion.
Fitted search_start(const ObjectFit& problem) {
  constexpr double kCell = 0.5;
  const int reach = static_cast<int>(problem.options.search_m / kCell);
  const int stride = std::max(1, static_cast<int>(problem.points.size()) / 60);
  Fitted best{problem.T_level};
  for (int ix = -reach; ix <= reach; ++ix) {
    for (int iy = -reach; iy <= reach; ++iy) {
      const Pose start = shifted_by(problem.T_level, ix * kCell, iy * kCell);
      const double score = score_of(problem, start, stride);
      if (score < best.score) best = {start, score};
    }
  }
  return best;
}

/// @param stop as converge has it.
Fitted best_fit(const ObjectFit& problem, const std::vector<Pose>& guesses, double stop) {
  Fitted best{guesses.front()};
  for (const Pose& guess : guesses) {
    if (&guess != &guesses.front() && guess.isApprox(guesses.front(), 1e-9)) continue;
    const Fitted fitted = converge(problem, guess, stop);
    if (fitted.score < best.score) best = fitted;
  }
  if (problem.options.search_m <= 0) return best;
  const Pose start = search_start(problem).T;
  if (start.isApprox(guesses.front(), 1e-9)) return best;  // has been gone from already
  // A far-off start may land on a neighbour that looks alike: it must be clearly better.
  const Fitted searched = converge(problem, start, stop);
  return searched.score < 0.8 * best.score ? searched : best;
}

}  // namespace

ObjectRegistrationOptions options_between_scans() {
  ObjectRegistrationOptions options;
  options.min_points = 10;
  options.max_points = 120;
  options.choosing_points = 60;
  options.search_m = 0;
  options.max_shift_m = 0.6;
  options.weigh_as = 10;
  options.max_iterations = 15;
  return options;
}

const char* to_string(RegistrationStatus status) {
  constexpr std::array<const char*, 4> kNames{"reliable", "too_few_points", "poor_overlap",
                                              "ambiguous"};
  return kNames.at(static_cast<std::size_t>(status));
}

ObjectRegistration register_object(const Points& points_object, const Surface& target,
                                   const std::vector<Pose>& guesses,
                                   const ObjectRegistrationOptions& options,
                                   const SeenSpace* seen) {
  if (guesses.empty()) {
    throw std::invalid_argument("register_object: needs at least one guess, the ego-motion");
  }
  ObjectRegistration result;
  result.T_target_object = guesses.front();
  if (static_cast<int>(points_object.size()) < options.min_points || target.points().empty()) {
    return result;
  }
  const Points points = evenly_thinned(points_object, static_cast<std::size_t>(options.max_points));
  const int choosing = options.choosing_points > 0 ? options.choosing_points : options.max_points;
  const Points few = evenly_thinned(points, static_cast<std::size_t>(choosing));
  const bool is_chosen_first = few.size() < points.size();
  const ObjectFit problem{points, target, guesses.front(), options, mean_of(points), seen};
  const ObjectFit coarse{few, target, guesses.front(), options, mean_of(few), seen};
  Fitted best = best_fit(coarse, guesses, is_chosen_first ? kGoodStart : kSettled);
  if (is_chosen_first) best = converge(problem, best.T, kSettled, 1);
  result.T_target_object = best.T;
  result.overlap = overlap_of(problem, best.T);
  if (result.overlap < options.min_overlap) {
    result.status = RegistrationStatus::poor_overlap;
    return result;
  }
  const SurfaceResidual residual = residual_of(problem, best.T);
  result.residual_m = residual.rms_m;
  result.num_points = residual.num_points;
  const Ambiguity ambiguity = ambiguity_of(coarse, {best.T, score_of(coarse, best.T)});
  result.spread_m = ambiguity.spread_m;
  result.slack = ambiguity.slack;
  result.status = result.spread_m > options.max_spread_m ? RegistrationStatus::ambiguous
                                                         : RegistrationStatus::reliable;
  return result;
}

}  // namespace lidar_upsampling
