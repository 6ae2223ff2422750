// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/mover_history.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/registration/surface.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kMostPoints = 400;
constexpr double kForesight_s = 0.5;
constexpr double kReach_m = 0.2;   // between points of two scans on one surface, level...
constexpr double kUpright = 5;     // ...and times as far upright: from ring to ring
constexpr double kLargest_m = 20;  // farther apart two road users' centroids share nothing

double seconds_apart(const MoversOfScan& a, const MoversOfScan& b) {
  return seconds_between(a.stamp, b.stamp);
}

// Level distances count most: rings lie apart.
Eigen::Vector3f flattened(const Eigen::Vector3f& point) {
  return {point.x(), point.y(), point.z() / static_cast<float>(kUpright)};
}

PointIndex flat_index(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> flat(points.size());
  std::transform(points.begin(), points.end(), flat.begin(), flattened);
  return PointIndex(std::move(flat));
}

// Of the points, those that have one of the index's near.
double share_near(const std::vector<Eigen::Vector3f>& points, const PointIndex& index,
                  double reach_m) {
  const auto sq_reach = static_cast<float>(reach_m * reach_m);
  const auto near = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3f& point) {
    return index.nearest(flattened(point), sq_reach).index >= 0;
  });
  return static_cast<double>(near) / std::max<double>(1, static_cast<double>(points.size()));
}

double reach_of(const ExpectedMover& mover) { return kReach_m + mover.sigma_m; }

/// Where the mover of one scan is at another scan; its motion in the history's frame at rest.
ExpectedMover moved_to(const MoversOfScan& there, const MoversOfScan& here, const Mover& mover,
                       const MotionPriorOptions& options) {
  const double dt = seconds_apart(there, here);
  const Twist rate = rate_over_ground(mover.motion, there.T_rest_lidar.linear().transpose(),
                                      mean_of(mover.points));
  const Pose T_here_there =
      here.T_rest_lidar.inverse() * there.T_rest_lidar * exp_se3(Twist(rate * dt));
  ExpectedMover expected;
  expected.class_name = mover.class_name;
  for (const Eigen::Vector3f& point : mover.points)
    expected.points.emplace_back(T_here_there.cast<float>() * point);
  expected.motion = mover.motion;
  const double age = std::abs(seconds_between(mover.motion.stamp, here.stamp));
  expected.motion.stamp = here.stamp;
  expected.motion.velocity_covariance +=
      std::pow(options.acceleration_sigma * age, 2) * Eigen::Matrix2d::Identity();
  expected.sigma_m = std::abs(dt) * std::sqrt(0.5 * mover.motion.velocity_covariance.trace()) +
                     0.5 * options.acceleration_sigma * dt * dt;
  return expected;
}

bool are_near(const Mover& mover, const ExpectedMover& expected) {
  return (mean_of(mover.points) - mean_of(expected.points)).norm() < kLargest_m;
}

// Either may be a part of the other.
bool shows(const MoversOfScan& scan, const ExpectedMover& expected) {
  constexpr double kMostly = 0.5;
  const PointIndex index = flat_index(expected.points);
  const double reach_m = reach_of(expected);
  return std::any_of(scan.movers.begin(), scan.movers.end(), [&](const Mover& mover) {
    return are_near(mover, expected) &&
           (share_near(mover.points, index, reach_m) > kMostly ||
            share_near(expected.points, flat_index(mover.points), reach_m) > kMostly);
  });
}

bool move_alike(const KnownMotion& a, const KnownMotion& b) {
  constexpr double kAlike = 1.5;  // m/s
  return (a.velocity_at_rest - b.velocity_at_rest).norm() < kAlike;
}

using Scans = MoverHistory::const_iterator;

// What further scans tell of it, too, where they show it to go on: none where they do not.
std::optional<Mover> seen_to_go_on(Scans there, Scans end, const Mover& mover,
                                   const MotionPriorOptions& options) {
  constexpr double kPartly = 0.3;
  std::vector<const KnownMotion*> further;
  for (auto scan = there + 1; scan != end; ++scan) {
    if (seconds_apart(*there, *scan) > kForesight_s) break;
    const ExpectedMover then = moved_to(*there, *scan, mover, options);
    const PointIndex index = flat_index(then.points);
    const auto is_it = [&](const Mover& other) {
      return move_alike(other.motion, mover.motion) && are_near(other, then) &&
             share_near(other.points, index, reach_of(then)) > kPartly;
    };
    const auto found = std::find_if(scan->movers.begin(), scan->movers.end(), is_it);
    if (found != scan->movers.end()) further.push_back(&found->motion);
  }
  if (further.empty()) return {};
  KnownMotion motion = *further.back();
  for (auto sight = further.rbegin() + 1; sight != further.rend(); ++sight)
    motion = fused(motion, **sight, options.acceleration_sigma);
  Mover result = mover;
  result.motion = fused(motion, mover.motion, options.acceleration_sigma);
  return result;
}

bool is_sure(const Mover& mover, const ExpectedMover& expected) {
  constexpr double kMostSigma_m = 0.4;
  constexpr double kSignificant = 5.99;  // chi-square of two degrees of freedom, one in twenty
  return expected.sigma_m < kMostSigma_m && evidence_of_motion(mover.motion) > kSignificant;
}

KnownMotion turned(KnownMotion motion, const Eigen::Matrix3d& R) {
  const Eigen::Matrix2d level = R.topLeftCorner<2, 2>();
  motion.velocity_at_rest = R * motion.velocity_at_rest;
  motion.velocity_covariance = level * motion.velocity_covariance * level.transpose();
  return motion;
}

}  // namespace

Mover make_mover(std::string class_name, const std::vector<Eigen::Vector3f>& points,
                 const KnownMotion& motion) {
  return {std::move(class_name), evenly_thinned(points, kMostPoints), motion};
}

std::vector<ExpectedMover> movers_of_later_scans(const MoverHistory& history, Stamp stamp,
                                                 const Eigen::Matrix3d& R_rest_lidar_k,
                                                 const MotionPriorOptions& options) {
  const auto is_before = [](const MoversOfScan& scan, Stamp value) { return scan.stamp < value; };
  const auto here = std::lower_bound(history.begin(), history.end(), stamp, is_before);
  if (here == history.end() || here->stamp != stamp) return {};
  const Eigen::Matrix3d turn = R_rest_lidar_k * here->T_rest_lidar.linear().transpose();
  std::vector<ExpectedMover> result;
  MoversOfScan told{here->stamp, here->T_rest_lidar, {}};
  for (auto there = here + 1; there != history.end(); ++there) {
    if (seconds_apart(*here, *there) > kForesight_s) break;
    for (const Mover& mover : there->movers) {
      const auto known = seen_to_go_on(there, history.end(), mover, options);
      if (!known) continue;
      ExpectedMover expected = moved_to(*there, *here, *known, options);
      if (!is_sure(*known, expected) || shows(told, expected)) continue;
      told.movers.push_back({expected.class_name, expected.points, expected.motion});
      expected.is_shown = shows(*here, expected);
      expected.motion = turned(expected.motion, turn);
      result.push_back(std::move(expected));
    }
  }
  return result;
}

std::vector<int> points_of_mover(const ExpectedMover& mover, const LidarScan& scan,
                                 const std::vector<std::uint8_t>& is_ground) {
  const PointIndex index = flat_index(mover.points);
  const auto sq_reach = static_cast<float>(std::pow(reach_of(mover), 2));
  std::vector<int> result;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!is_ground.empty() && is_ground[i] != 0) continue;
    if (index.nearest(flattened(scan.points[i]), sq_reach).index >= 0)
      result.push_back(static_cast<int>(i));
  }
  return result;
}

}  // namespace lidar_upsampling
