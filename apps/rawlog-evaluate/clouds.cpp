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

/// A cloud that is searched, and its part in the cameras' view.
struct SearchedCloud {
  SearchedCloud(const Points& points, const std::vector<View>& views)
      : index(points), seen_index(seen_only(points, views, seen)) {}

  [[nodiscard]] const Points& points() const { return index.points(); }

  static Points seen_only(const Points& points, const std::vector<View>& views,
                          std::vector<bool>& seen) {
    Points part;
    for (const auto& point : points) {
      seen.push_back(in_view(views, point.cast<double>()));
      if (seen.back()) part.push_back(point);
    }
    return part;
  }

  PointIndex index;
  std::vector<bool> seen;
  PointIndex seen_index;
};

/// Squared, of one cloud's points to another: of all to all, and of those in view to those in view.
struct SqDistances {
  std::vector<float> all, in_view;
};

/// @param beside distances to a cloud that is to count as a part of `to`.
SqDistances sq_distances(const SearchedCloud& from, const SearchedCloud& to,
                         const SqDistances* beside = nullptr) {
  const auto nearest = nearest_neighbors(from.points(), to.index, beside ? &beside->all : nullptr);
  SqDistances result;
  Points searched;
  std::vector<float> searched_beside;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    result.all.push_back(nearest[i].sq_distance);
    if (!from.seen[i]) continue;
    const std::size_t place = result.in_view.size();
    result.in_view.push_back(nearest[i].sq_distance);
    // What is nearest of all and in view is nearest of what is in view.
    if (nearest[i].index >= 0 && to.seen[nearest[i].index]) continue;
    searched.push_back(from.points()[i]);
    if (beside != nullptr) searched_beside.push_back(beside->in_view[place]);
    places.push_back(place);
  }
  const auto seen = nearest_neighbors(searched, to.seen_index, beside ? &searched_beside : nullptr);
  for (std::size_t i = 0; i < places.size(); ++i) result.in_view[places[i]] = seen[i].sq_distance;
  return result;
}

CloudResult chamfers_of(const SqDistances& forward, const SqDistances& backward) {
  CloudResult result;
  result.full = chamfer_of(forward.all, backward.all);
  if (!forward.in_view.empty() && !backward.in_view.empty())
    result.in_view = chamfer_of(forward.in_view, backward.in_view);
  return result;
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
  SharedScene(const SearchedCloud& scene, const SearchedCloud& reference)
      : reference_(reference),
        forward_(sq_distances(scene, reference)),
        backward_(sq_distances(reference, scene)) {}

  /// @param objects where a row puts the others.
  [[nodiscard]] CloudResult with(const SearchedCloud& objects) const {
    SqDistances forward = sq_distances(objects, reference_);
    forward.all.insert(forward.all.end(), forward_.all.begin(), forward_.all.end());
    forward.in_view.insert(forward.in_view.end(), forward_.in_view.begin(), forward_.in_view.end());
    return chamfers_of(forward, sq_distances(reference_, objects, &backward_));
  }

 private:
  const SearchedCloud& reference_;
  SqDistances forward_, backward_;
};

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
  const std::vector<View> views = views_of(cameras, reference);
  const SearchedCloud truth(reference.points, views);
  const std::vector<bool> of_object = points_of_objects(clouds[Row::ego].size(), result.objects);
  const SharedScene scene({part_of(clouds[Row::ego], of_object, false), views}, truth);
  // Nothing is sampled here: the floor is zero, and left out.
  tbb::parallel_for(std::size_t{1}, kRows.size(), [&](std::size_t i) {
    const Row row = kRows[i];
    if (clouds[row].empty()) return;
    if (shares_scene(row)) {
      result.clouds[row] = scene.with({part_of(clouds[row], of_object, true), views});
    } else {
      const SearchedCloud cloud(clouds[row], views);
      result.clouds[row] = chamfers_of(sq_distances(cloud, truth), sq_distances(truth, cloud));
    }
  });
}

}  // namespace lidar_upsampling
