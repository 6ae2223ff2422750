// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/scan_registration.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/registration/nearest_point.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/registration/voxel_grid.h"

namespace lidar_upsampling {

namespace {

constexpr double kVoxel_m = 0.5;                       // both scans: one point per cube
constexpr std::size_t kMaxPoints = 5000;               // of the source, after thinning
constexpr double kMinRange_m = 2.5, kMaxRange_m = 80;  // nearer points are the vehicle itself
constexpr double kMaxCorrespondence_m = 1.5;
constexpr double kKernel_m = 0.1;        // Geman-McClure scale at the end, a fifth of the first
constexpr double kMinInlierShare = 0.4;  // points nearer than three kernel scales to their plane
constexpr int kMaxIterations = 30;
constexpr int kMinCorrespondences = 60;
// A direction counts as free if this share of the points would hold it: the normals' own noise
// does.
constexpr double kMinHold = 0.002;

/// A source point on the plane of its nearest target point; if it has one.
struct Match {
  Twist jacobian;
  double residual = 0;
  bool valid = false;
  NearestPoint nearest;
};

std::vector<Eigen::Vector3f> thinned(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> kept;
  std::copy_if(points.begin(), points.end(), std::back_inserter(kept), [](const auto& point) {
    const double sq_range = point.squaredNorm();
    return sq_range > kMinRange_m * kMinRange_m && sq_range < kMaxRange_m * kMaxRange_m;
  });
  return group_by_voxel(kept, kVoxel_m).means;
}

/// @param match in and out, of the iteration before and of this one.
void match_point(const Eigen::Vector3f& point, const Surface& target, Match& match) {
  constexpr auto kReach_m = static_cast<float>(kMaxCorrespondence_m);
  match.valid = false;
  look_up(target, point, kReach_m, match.nearest);
  if (match.nearest.index < 0) return;
  const Eigen::Vector3d normal = target.normal(match.nearest.index).cast<double>();
  if (normal.isZero()) return;
  const Eigen::Vector3d p = point.cast<double>();
  match.residual = normal.dot(p - target.points()[match.nearest.index].cast<double>());
  match.jacobian << p.cross(normal), normal;
  match.valid = true;
}

void match_all(const std::vector<Eigen::Vector3f>& source, const Surface& target,
               const Pose& T_target_source, std::vector<Match>& matches) {
  const Eigen::Isometry3f T = T_target_source.cast<float>();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, source.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      match_point(T * source[i], target, matches[i]);
  });
}

struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Twist b = Twist::Zero();
  int num_matches = 0;
  int num_inliers = 0;
  double sq_residuals = 0;
};

NormalEquations accumulate(const std::vector<Match>& matches, double scale, double inlier_m) {
  NormalEquations sum;
  for (const Match& match : matches) {
    if (!match.valid) {
      continue;
    }
    const double sq_scale = scale * scale;
    const double root = sq_scale / (sq_scale + match.residual * match.residual);
    sum.H.noalias() += root * root * match.jacobian * match.jacobian.transpose();
    sum.b -= root * root * match.residual * match.jacobian;
    ++sum.num_matches;
    if (std::abs(match.residual) < inlier_m) {
      ++sum.num_inliers;
      sum.sq_residuals += match.residual * match.residual;
    }
  }
  return sum;
}

/// The covariance, or none if some direction is free.
std::optional<Matrix6d> covariance_of(const Matrix6d& H, int num_matches, double rmse) {
  const double variance = std::max(1e-4, rmse * rmse);
  const SymmetricEigen<6> eigen = symmetric_eigen<6>(H);
  if (!(eigen.values[0] > kMinHold * num_matches)) {
    return std::nullopt;
  }
  return variance * eigen.vectors * eigen.values.cwiseInverse().asDiagonal() *
         eigen.vectors.transpose();
}

std::optional<Registration> iterate(const std::vector<Eigen::Vector3f>& source,
                                    const Surface& target, const Pose& guess) {
  Registration result;
  result.T_target_source = guess;
  std::vector<Match> matches(source.size());
  NormalEquations sum;
  double scale = 5 * kKernel_m;
  for (int i = 0; i < kMaxIterations; ++i) {
    match_all(source, target, result.T_target_source, matches);
    sum = accumulate(matches, scale, 3 * kKernel_m);
    if (sum.num_matches < kMinCorrespondences) {
      return std::nullopt;
    }
    const Twist step = solved<6, 1>(sum.H, sum.b);
    if (!step.allFinite()) {
      return std::nullopt;
    }
    result.T_target_source = renormalized(exp_se3(step) * result.T_target_source);
    const bool narrow = scale <= kKernel_m;
    if (narrow && step.head<3>().norm() < 5e-5 && step.tail<3>().norm() < 5e-4) {
      break;
    }
    scale = std::max(kKernel_m, 0.6 * scale);
  }
  result.inlier_share = static_cast<double>(sum.num_inliers) / sum.num_matches;
  result.rmse_m = std::sqrt(sum.sq_residuals / std::max(1, sum.num_inliers));
  const auto covariance = covariance_of(sum.H, sum.num_matches, result.rmse_m);
  if (!covariance || result.inlier_share < kMinInlierShare) {
    return std::nullopt;
  }
  result.covariance = *covariance;
  const Eigen::Vector3d gone = result.T_target_source.translation(), expected = guess.translation();
  result.way = gone.norm() > expected.norm() ? gone : expected;
  const Eigen::Vector3d along = result.way.normalized();
  result.hold = along.dot(sum.H.bottomRightCorner<3, 3>() * along) / sum.num_matches;
  return result;
}

}  // namespace

std::optional<Registration> register_scans(const std::vector<Eigen::Vector3f>& points_source,
                                           const std::vector<Eigen::Vector3f>& points_target,
                                           const Pose& T_target_source_guess) {
  std::vector<Eigen::Vector3f> source, target;
  tbb::parallel_invoke([&] { source = evenly_thinned(thinned(points_source), kMaxPoints); },
                       [&] { target = thinned(points_target); });
  if (source.size() < kMinCorrespondences || target.size() < kMinCorrespondences) {
    return std::nullopt;
  }
  const Surface surface = Surface(std::move(target));
  return iterate(source, surface, T_target_source_guess);
}

}  // namespace lidar_upsampling
