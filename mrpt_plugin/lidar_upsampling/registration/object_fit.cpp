// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/object_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lidar_upsampling {
namespace {

bool are_enough(const ObjectFit& fit, int visible, int all) {
  constexpr double kLeastShare = 0.25;
  const double least = fit.options.min_points / static_cast<double>(fit.points.size());
  return visible == all || visible >= std::max(kLeastShare, least) * all;
}

}  // namespace

Sight sight_in(const ObjectFit& fit, const Eigen::Vector3f& place) {
  return fit.clues.seen == nullptr ? Sight::open : fit.clues.seen->at(place);
}

double score_of(const ObjectFit& fit, const Pose& T_target_object, int stride, double worse_than) {
  const Eigen::Isometry3f T = T_target_object.cast<float>();
  constexpr auto kFarthest = static_cast<float>(kScoreCut * kScoreCut);
  const double just_covered = fit.options.overlap_distance_m;
  double sum = 0;
  int count = 0, visible = 0;
  const std::size_t asked = (fit.points.size() + stride - 1) / stride;
  const double sum_of_worse = worse_than * worse_than * static_cast<double>(asked);
  for (std::size_t i = 0; i < fit.points.size(); i += stride, ++count) {
    if (sum > sum_of_worse) return std::numeric_limits<double>::infinity();
    const Eigen::Vector3f place = T * fit.points[i];
    const Sight sight = sight_in(fit, place);
    visible += sight == Sight::hidden ? 0 : 1;
    if (sight == Sight::hidden)
      sum += just_covered * just_covered;
    else if (sight == Sight::seen_through)
      sum += kScoreCut * kScoreCut;
    else
      sum += std::min(fit.target.nearest(place, kFarthest).sq_distance, kFarthest);
  }
  return are_enough(fit, visible, count) ? std::sqrt(sum / count) : kScoreCut;
}

double rank_of(const ObjectFit& fit, const Pose& T_target_object, double score) {
  // Neighbouring points err alike: all of them speak as loud as ten that fit to a decimetre.
  constexpr double kSqScorePerChiSquare = 0.1 * 0.1 / 10;  // m^2
  if (fit.clues.expected == nullptr) return score;
  const Eigen::Vector2d astray =
      (T_target_object * fit.centroid).head<2>() - fit.clues.expected->centroid;
  const double chi_square = astray.dot(fit.clues.expected->covariance.ldlt().solve(astray));
  return std::sqrt(score * score + kSqScorePerChiSquare * chi_square);
}

double residual_of(const ObjectFit& fit, const Pose& T_target_object) {
  double sum = 0;
  int count = 0;
  for (const auto& point : fit.points) {
    const Eigen::Vector3f at = T_target_object.cast<float>() * point;
    if (sight_in(fit, at) == Sight::hidden) continue;
    const auto nearest = fit.target.nearest(at);
    const Eigen::Vector3f normal = fit.target.normal(nearest.index);
    const Eigen::Vector3f error = at - fit.target.points()[nearest.index];
    const double sq = normal.isZero() ? error.squaredNorm() : std::pow(normal.dot(error), 2);
    sum += std::min(sq, kScoreCut * kScoreCut);
    ++count;
  }
  return std::sqrt(sum / std::max(1, count));
}

Sampling sampling_under(const ObjectFit& fit, const Pose& T_target_object) {
  const Eigen::Isometry3f T = T_target_object.cast<float>();
  const auto reach = static_cast<float>(std::pow(fit.options.overlap_distance_m, 2));
  Eigen::Matrix2d all = 1e-9 * Eigen::Matrix2d::Identity(), along = Eigen::Matrix2d::Zero();
  std::vector<float> spacings;
  for (const Eigen::Vector3f& point : fit.points) {
    const Eigen::Vector3f place = T * point;
    if (sight_in(fit, place) == Sight::hidden) continue;
    const auto nearest = fit.target.nearest(place, reach);
    if (nearest.index < 0) continue;
    spacings.push_back(fit.target.spacing(nearest.index));
    const Eigen::Vector3d normal = fit.target.normal(nearest.index).cast<double>();
    const Eigen::Matrix2d across = (normal * normal.transpose()).topLeftCorner<2, 2>();
    const double weight = normal.isZero() ? 1 : fit.options.point_weight;
    along += weight * (Eigen::Matrix2d::Identity() - across);
    all += weight * (Eigen::Matrix2d::Identity() - across) + across;
  }
  if (spacings.empty()) return {};
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return {*middle, all.inverse() * along};
}

double overlap_of(const ObjectFit& fit, const Pose& T_target_object) {
  const Eigen::Isometry3f T = T_target_object.cast<float>();
  const auto reach = static_cast<float>(fit.options.overlap_distance_m);
  int visible = 0, covered = 0;
  for (const Eigen::Vector3f& point : fit.points) {
    const Eigen::Vector3f place = T * point;
    if (sight_in(fit, place) == Sight::hidden) continue;
    ++visible;
    covered += fit.target.nearest(place, reach * reach).index >= 0 ? 1 : 0;
  }
  const bool tells = are_enough(fit, visible, static_cast<int>(fit.points.size()));
  return tells ? static_cast<double>(covered) / visible : 0;
}

}  // namespace lidar_upsampling
