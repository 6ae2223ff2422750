// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/standing_part.h"

#include <algorithm>
#include <limits>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kStands_px = 1;    // the noise of a point's place, and what the ego-motion errs
constexpr double kMoves_px = 1.8;   // sure not to stand
constexpr double kApart_m = 0.2;    // between what stands and what moves
constexpr double kMostTold = 0.8;   // share of points that do either
constexpr double kAgree = 0.85;     // share of the moving part's points that tell its motion
constexpr double kUpright_m = 0.4;  // of them, at least: what one ring shows may be an edge

struct Sides {
  std::vector<Correspondence> standing, moving;
};

// By how far each is from where a static point would be.
Sides sides_of(const std::vector<Correspondence>& correspondences, const MotionQuery& query) {
  const Pose T_camera_t_lidar_k = query.T_camera_lidar * query.T_lidar_t_lidar_k;
  Sides sides;
  for (const Correspondence& pair : correspondences) {
    const auto static_px = project(query.camera, T_camera_t_lidar_k * pair.point_in_source);
    if (!static_px) continue;
    const double apart_px = (pair.pixel - *static_px).norm();
    if (apart_px < kStands_px) sides.standing.push_back(pair);
    if (apart_px > kMoves_px) sides.moving.push_back(pair);
  }
  return sides;
}

double sq_distance(const Correspondence& pair, const std::vector<Correspondence>& others) {
  double nearest = std::numeric_limits<double>::max();
  for (const Correspondence& other : others)
    nearest = std::min(nearest, (pair.point_in_source - other.point_in_source).squaredNorm());
  return nearest;
}

bool lie_apart(const Sides& sides) {
  return std::all_of(sides.moving.begin(), sides.moving.end(), [&](const Correspondence& pair) {
    return sq_distance(pair, sides.standing) > kApart_m * kApart_m;
  });
}

double height_of(const std::vector<Correspondence>& part) {
  const auto by_z = [](const Correspondence& a, const Correspondence& b) {
    return a.point_in_source.z() < b.point_in_source.z();
  };
  const auto [low, high] = std::minmax_element(part.begin(), part.end(), by_z);
  return high->point_in_source.z() - low->point_in_source.z();
}

// Whether the mover's motion would take along what stands: seen from ahead, a part of what comes
// near seems to stand.
bool goes_along(const Sides& sides, const ObjectMotion& motion, const MotionQuery& query) {
  constexpr double kFew = 0.25;
  const Pose T_camera_t_lidar_k = query.T_camera_lidar * motion.T_lidar_t_lidar_k;
  const auto near =
      std::count_if(sides.standing.begin(), sides.standing.end(), [&](const Correspondence& pair) {
        const auto moved_px = project(query.camera, T_camera_t_lidar_k * pair.point_in_source);
        return moved_px && (pair.pixel - *moved_px).norm() < kStands_px;
      });
  return static_cast<double>(near) > kFew * static_cast<double>(sides.standing.size());
}

}  // namespace

std::vector<std::uint8_t> standing_part(const std::vector<Correspondence>& correspondences,
                                        const MotionQuery& query,
                                        const ObjectMotionOptions& options) {
  const Sides sides = sides_of(correspondences, query);
  const auto fewest = static_cast<std::size_t>(options.min_points);
  const std::size_t num_told = sides.standing.size() + sides.moving.size();
  if (sides.standing.size() < fewest || sides.moving.size() < fewest ||
      static_cast<double>(num_told) < kMostTold * static_cast<double>(correspondences.size()) ||
      height_of(sides.moving) < kUpright_m || !lie_apart(sides))
    return {};
  const ObjectMotion motion = estimate_object_motion(sides.moving, query, options);
  if (motion.status != MotionStatus::moving ||
      motion.num_inliers < kAgree * static_cast<double>(sides.moving.size()) ||
      goes_along(sides, motion, query))
    return {};
  std::vector<std::uint8_t> stands;
  stands.reserve(correspondences.size());
  for (const Correspondence& pair : correspondences)
    stands.push_back(sq_distance(pair, sides.standing) < sq_distance(pair, sides.moving) ? 1 : 0);
  return stands;
}

}  // namespace lidar_upsampling
