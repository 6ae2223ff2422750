// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/ambiguity.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lidar_upsampling {
namespace {

/// Whether the object may as well be out of the target's sight there: all of it is hidden, and what
/// it was matched to need not be its own, as it would not have been seen from where the object was.
bool may_hide_at(const ObjectFit& problem, const Pose& T, const Fitted& best) {
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

}  // namespace

Ambiguity ambiguity_of(const ObjectFit& problem, const Fitted& best) {
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
      const Fitted again = converge(problem, start, stop);
      if (again.score >= 1.15 * best.score + 0.005) continue;
      astray = (again.T * problem.centroid - best.T * problem.centroid).head<2>();
    }
    result.spread_m = std::max(result.spread_m, astray.norm());
    const Eigen::Vector2d deviation = deviation_of(astray, shift_m);
    result.slack += 0.5 * deviation * deviation.transpose();  // every axis is tried both ways
  }
  const double sq_phase = sampling.spacing_m * sampling.spacing_m / 12;
  if (std::isfinite(sq_phase)) result.slack += sq_phase * sampling.pull * sampling.pull.transpose();
  return result;
}

}  // namespace lidar_upsampling
