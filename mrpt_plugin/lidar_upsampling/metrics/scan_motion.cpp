// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/scan_motion.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <unordered_map>

namespace lidar_upsampling {

namespace {

using Pairs = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

bool has_beams(const LidarScan& scan) {
  return scan.size() > 0 && scan.ring.size() == scan.size() && scan.column.size() == scan.size();
}

std::uint32_t beam(const LidarScan& scan, std::size_t i) {
  return static_cast<std::uint32_t>(scan.ring[i]) << 16 | scan.column[i];
}

std::unordered_map<std::uint32_t, int> points_by_beam(const LidarScan& scan) {
  std::unordered_map<std::uint32_t, int> points;
  points.reserve(2 * scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto [place, is_new] = points.emplace(beam(scan, i), static_cast<int>(i));
    if (!is_new) {
      place->second = -1;
    }
  }
  return points;
}

Pose closed_form(const Pairs& pairs) {
  Eigen::Matrix3Xd source(3, pairs.size()), target(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    source.col(static_cast<int>(i)) = pairs[i].first;
    target.col(static_cast<int>(i)) = pairs[i].second;
  }
  return Pose(Eigen::umeyama(source, target, false));
}

Pairs inliers_of(const Pairs& pairs, const Pose& T, double inlier_m) {
  Pairs inliers;
  for (const auto& pair : pairs) {
    if ((T * pair.first - pair.second).squaredNorm() < inlier_m * inlier_m) {
      inliers.push_back(pair);
    }
  }
  return inliers;
}

/// Refits twice on what agrees.
Pairs grow(const Pairs& pairs, Pose& T, double inlier_m) {
  Pairs inliers = inliers_of(pairs, T, inlier_m);
  for (int round = 0; round < 2 && inliers.size() >= 3; ++round) {
    T = closed_form(inliers);
    inliers = inliers_of(pairs, T, inlier_m);
  }
  return inliers;
}

constexpr double kSame_m = 0.003;

/// Whether most of what has changed lies on its own beams still, nearer or farther: moved points
/// leave them.
bool changed_along_beams(const Pairs& pairs) {
  constexpr double kChanged_m = 0.03;
  int changed = 0, along = 0;
  for (const auto& [source, target] : pairs) {
    if ((target - source).norm() < kChanged_m) continue;
    ++changed;
    along += source.normalized().cross(target).norm() < kSame_m ? 1 : 0;
  }
  return 2 * along > changed;
}

/// Whether the matched points are other points than the key scan's: drawn anew on the beams, or
/// measured by the sensor itself. Moved points keep their distances to the millimetre, most of them
/// with the static scene; those of a sensor at rest are the same in any case.
bool is_other_points(const LidarScan& key, const LidarScan& virtual_scan,
                     const std::vector<int>& matches) {
  constexpr std::size_t kEnough = 2000;
  Pairs pairs;
  for (std::size_t i = 0; i < key.size(); ++i)
    if (matches[i] >= 0)
      pairs.emplace_back(key.points[i].cast<double>(),
                         virtual_scan.points[matches[i]].cast<double>());
  const std::size_t step = pairs.size() / kEnough + 1;
  Pairs thinned;
  for (std::size_t i = 0; i < pairs.size(); i += step) thinned.push_back(pairs[i]);
  return !fit_rigid(thinned, kSame_m) || changed_along_beams(pairs);
}

}  // namespace

std::vector<int> match_by_beam(const LidarScan& key, const LidarScan& virtual_scan) {
  if (!has_beams(key) || !has_beams(virtual_scan)) {
    return {};
  }
  const auto keys = points_by_beam(key);
  const auto virtuals = points_by_beam(virtual_scan);
  std::vector<int> matches(key.size(), -1);
  for (std::size_t i = 0; i < key.size(); ++i) {
    const auto found = virtuals.find(beam(key, i));
    if (found != virtuals.end() && keys.at(found->first) >= 0) {
      matches[i] = found->second;
    }
  }
  if (is_other_points(key, virtual_scan, matches)) {
    return {};
  }
  return matches;
}

std::vector<int> match_in_order(const LidarScan& key, const LidarScan& virtual_scan) {
  if (key.size() != virtual_scan.size()) {
    return {};
  }
  std::vector<int> matches(key.size());
  std::iota(matches.begin(), matches.end(), 0);
  if (is_other_points(key, virtual_scan, matches)) {
    return {};
  }
  return matches;
}

std::optional<Pose> fit_rigid(const Pairs& pairs, double inlier_m) {
  if (pairs.size() < 3) {
    return std::nullopt;
  }
  Pose best = closed_form(pairs);
  Pairs inliers = grow(pairs, best, inlier_m);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, pairs.size() - 1);
  for (int trial = 0; trial < 50 && 2 * inliers.size() <= pairs.size(); ++trial) {
    Pose T = closed_form({pairs[any(random)], pairs[any(random)], pairs[any(random)]});
    Pairs agreeing = grow(pairs, T, inlier_m);
    if (agreeing.size() > inliers.size()) {
      best = T;
      inliers = std::move(agreeing);
    }
  }
  return 2 * inliers.size() > pairs.size() ? std::make_optional(best) : std::nullopt;
}

}  // namespace lidar_upsampling
