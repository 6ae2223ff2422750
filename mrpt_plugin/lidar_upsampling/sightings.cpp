// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/sightings.h"

#include <algorithm>
#include <iterator>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kFewest = 6;

std::vector<int> common(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> result;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

std::vector<int> without(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

// Whether the next scan shows a surface where these points are.
bool stay(const std::vector<int>& points, const KeyScanView& key) {
  constexpr float kStays_m = 0.2F;
  constexpr double kNearlyAll = 0.7;
  if (key.next == nullptr) return true;
  const Eigen::Isometry3f T_next_k = key.next->T_lidar_next_lidar_k.cast<float>();
  const auto there = std::count_if(points.begin(), points.end(), [&](int i) {
    return key.next->surface.nearest(T_next_k * key.scan.points[i], kStays_m * kStays_m).index >= 0;
  });
  return static_cast<double>(there) > kNearlyAll * static_cast<double>(points.size());
}

// Gives a sighting that is the mover its motion, and takes from one that holds it, with what stays
// behind, its points away; a few points are a neighbour's.
// @param points of the mover; those that stay with the sighting go.
void join(Sighting& sighting, const ExpectedMover& mover, std::vector<int>& points,
          const KeyScanView& key) {
  constexpr double kIsAll = 0.6;
  const std::vector<int> shared = common(sighting.points, points);
  if (shared.empty()) return;
  std::vector<int> rest = without(sighting.points, shared);
  const bool touches = shared.size() >= kFewest;
  const bool is_mover =
      static_cast<double>(shared.size()) > kIsAll * static_cast<double>(sighting.points.size());
  if (touches && !is_mover && !mover.is_shown && stay(rest, key)) {
    sighting.points = std::move(rest);
    return;
  }
  if (touches && (is_mover || !mover.is_shown)) sighting.foreseen = mover.motion;
  points = without(points, shared);
}

std::optional<Detection> detection_of(const ExpectedMover& mover, const std::vector<int>& points,
                                      const KeyScanView& key, const CameraModel& camera,
                                      const Pose& T_camera_lidar) {
  Detection detection{Box2d::around_nothing(), mover.class_name, 1., -1, {}};
  std::size_t count = 0;
  for (const int i : points) {
    const auto pixel = project(camera, T_camera_lidar * key.scan.points[i].cast<double>());
    if (!pixel) continue;
    ++count;
    detection.box.extend(pixel->x(), pixel->y());
  }
  if (count < kFewest) return {};
  return detection;
}

}  // namespace

void find_expected(std::vector<Sighting>& sightings, const KeyScanView& key,
                   const CameraModel& camera, const Pose& T_camera_lidar) {
  if (key.expected.empty()) return;
  for (Sighting& sighting : sightings) std::sort(sighting.points.begin(), sighting.points.end());
  for (const ExpectedMover& mover : key.expected) {
    std::vector<int> points = points_of_mover(mover, key.scan, key.segments.ground.is_ground);
    for (Sighting& sighting : sightings) join(sighting, mover, points, key);
    if (mover.is_shown || points.size() < kFewest) continue;
    auto detection = detection_of(mover, points, key, camera, T_camera_lidar);
    if (detection) sightings.push_back({std::move(*detection), std::move(points), mover.motion});
  }
  const auto is_left_over = [](const Sighting& sighting) {
    return sighting.points.size() < kFewest;
  };
  sightings.erase(std::remove_if(sightings.begin(), sightings.end(), is_left_over),
                  sightings.end());
}

}  // namespace lidar_upsampling
