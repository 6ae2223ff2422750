// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "clouds.h"

#include <tbb/parallel_for.h>

#include <limits>
#include <optional>

#include "lidar_upsampling/metrics/chamfer.h"

namespace lidar_upsampling {

namespace {

Points moved(const Points& points, const Pose& T) {
  Points result;
  result.reserve(points.size());
  for (const auto& point : points) result.emplace_back((T * point.cast<double>()).cast<float>());
  return result;
}

Points seen_only(const Points& points, const std::vector<View>& views,
                 std::vector<bool>* of_object = nullptr) {
  Points result;
  std::vector<bool> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!in_view(views, points[i].cast<double>())) continue;
    result.push_back(points[i]);
    if (of_object != nullptr) kept.push_back((*of_object)[i]);
  }
  if (of_object != nullptr) *of_object = std::move(kept);
  return result;
}

/// By the ego-motion, objects by the row's own estimate.
Points moved_with_objects(const RowSources& sources, const std::vector<ObjectResult>& objects,
                          Row row) {
  const Points& key = sources.scans.key.points;
  Points cloud = moved(key, sources.T_ego);
  for (const ObjectResult& object : objects) {
    if (!object.object.excluded.empty() || !object.estimates[row]) continue;
    for (const int i : object.object.points)
      cloud[i] = (*object.estimates[row] * key[i].cast<double>()).cast<float>();
  }
  return cloud;
}

/// The points of an object of the scan, or the others.
Points part_of(const Points& cloud, const std::vector<bool>& of_object, bool objects) {
  Points part;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (of_object[i] == objects) part.push_back(cloud[i]);
  return part;
}

/// Rows that move the scene by the ego-motion and only objects otherwise: the scene is searched
/// once for all of them.
class SharedScene {
 public:
  /// @param ego the whole scan moved by the ego-motion.
  /// @param of_object its points that rows move otherwise.
  SharedScene(const Points& ego, const std::vector<bool>& of_object, const Points& reference,
              const PointIndex& reference_index)
      : reference_(reference), reference_index_(reference_index) {
    const Points scene = part_of(ego, of_object, false);
    forward_ = nearest_sq_distances(scene, reference_index);
    if (scene.empty())
      backward_.assign(reference.size(), std::numeric_limits<float>::max());
    else
      backward_ = nearest_sq_distances(reference, PointIndex(scene));
  }

  [[nodiscard]] bool empty() const { return forward_.empty(); }

  /// @param objects where a row puts the others. @throw std::invalid_argument nothing at all.
  [[nodiscard]] Chamfer chamfer(const Points& objects) const {
    if (objects.empty()) return chamfer_of(forward_, backward_);
    std::vector<float> forward = nearest_sq_distances(objects, reference_index_);
    forward.insert(forward.end(), forward_.begin(), forward_.end());
    return chamfer_of(forward, nearest_sq_distances(reference_, PointIndex(objects), &backward_));
  }

 private:
  const Points& reference_;
  const PointIndex& reference_index_;
  std::vector<float> forward_, backward_;
};

Chamfer chamfer_to(const Points& cloud, const Points& reference, const PointIndex& index) {
  return chamfer_of(nearest_sq_distances(cloud, index),
                    nearest_sq_distances(reference, PointIndex(cloud)));
}

bool shares_scene(Row row) {
  return row == Row::ego || row == Row::constant_velocity || row == Row::oracle;
}

std::vector<bool> points_of_objects(std::size_t num_points,
                                    const std::vector<ObjectResult>& objects) {
  std::vector<bool> of_object(num_points);
  for (const ObjectResult& object : objects)
    for (const int i : object.object.points) of_object[i] = true;
  return of_object;
}

}  // namespace

PerRow<Points> whole_clouds(const RowSources& sources, const std::vector<ObjectResult>& objects) {
  const ScanSet& scans = sources.scans;
  PerRow<Points> clouds;
  clouds[Row::floor] = scans.reference.points;
  clouds[Row::hold] = scans.key.points;
  clouds[Row::ego] = moved(scans.key.points, sources.T_ego);
  clouds[Row::constant_velocity] = moved_with_objects(sources, objects, Row::constant_velocity);
  if (sources.paper) clouds[Row::paper] = sources.paper->scan->points;
  clouds[Row::ours] = scans.virtual_scan.points;
  clouds[Row::oracle] = moved_with_objects(sources, objects, Row::oracle);
  return clouds;
}

void measure_clouds(const PerRow<Points>& clouds, const LidarScan& reference,
                    const std::vector<Camera>& cameras, ScanResult& result) {
  if (reference.points.empty()) return;
  const Points& ego = clouds[Row::ego];
  const PointIndex index(reference.points);
  const std::vector<bool> of_object = points_of_objects(ego.size(), result.objects);
  const SharedScene scene(ego, of_object, reference.points, index);
  const std::vector<View> views = views_of(cameras, reference);
  const Points seen = seen_only(reference.points, views);
  const PointIndex seen_index(seen);
  std::vector<bool> seen_of_object = of_object;
  const Points ego_seen = seen_only(ego, views, &seen_of_object);
  std::optional<SharedScene> seen_scene;
  if (!seen.empty()) seen_scene.emplace(ego_seen, seen_of_object, seen, seen_index);
  // Nothing is sampled here: the floor is zero, and left out.
  tbb::parallel_for(std::size_t{1}, kRows.size(), [&](std::size_t i) {
    const Row row = kRows[i];
    if (clouds[row].empty()) return;
    CloudResult cloud;
    if (shares_scene(row)) {
      const Points objects = part_of(clouds[row], of_object, true);
      cloud.full = scene.chamfer(objects);
      const Points objects_seen = seen_only(objects, views);
      if (seen_scene && !(seen_scene->empty() && objects_seen.empty()))
        cloud.in_view = seen_scene->chamfer(objects_seen);
    } else {
      cloud.full = chamfer_to(clouds[row], reference.points, index);
      const Points own_seen = seen_only(clouds[row], views);
      if (!seen.empty() && !own_seen.empty())
        cloud.in_view = chamfer_to(own_seen, seen, seen_index);
    }
    result.clouds[row] = cloud;
  });
}

}  // namespace lidar_upsampling
