// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "key_objects.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

namespace {

/// As large as road users are; walls and hedges have no motion to measure.
bool is_object(const ClusterExtent& extent, const std::vector<int>& cluster) {
  const ClusterDetectorOptions size;
  return static_cast<int>(cluster.size()) >= size.min_points && extent.top >= size.min_height &&
         extent.top <= size.max_height && extent.bottom <= size.max_bottom &&
         extent.length >= size.min_length && extent.length <= size.max_length &&
         extent.width <= size.max_width;
}

/// Points of the scan inside a box grown by a tenth of a metre.
std::vector<int> points_in_box(const LidarScan& scan, const Ground& ground, const Pose& T_box_lidar,
                               const Eigen::Vector3d& size) {
  const Eigen::Array3d reach = 0.5 * size.array() + 0.1;
  const Eigen::Vector3d centre = T_box_lidar.inverse().translation();
  const double reach_sq = reach.matrix().squaredNorm();
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(scan.size()); ++i) {
    const Eigen::Vector3d point = scan.points[i].cast<double>();
    if ((point - centre).squaredNorm() > reach_sq) continue;
    const bool on_ground = !ground.is_ground.empty() && ground.is_ground[i] != 0;
    if (!on_ground && ((T_box_lidar * point).array().abs() < reach).all()) points.push_back(i);
  }
  return points;
}

}  // namespace

std::vector<ObjectReference> objects_by_clusters(const LidarScan& key) {
  const SceneSegments segments = segment_scan(key);
  std::vector<ObjectReference> objects;
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    if (!is_object(segments.extents[i], segments.clusters[i])) continue;
    ObjectReference object;
    object.id = std::to_string(i);
    object.class_name = "cluster";
    object.points = segments.clusters[i];
    object.motion.centroid_k = mean_of(points_at(key, object.points));
    objects.push_back(std::move(object));
  }
  return objects;
}

std::vector<ObjectReference> objects_by_truth(const LidarScan& key, const Truth& truth,
                                              int min_points) {
  const Ground ground = estimate_ground(key);
  std::vector<ObjectReference> objects;
  for (const TrueObject& box : truth.objects) {
    const auto T_box_lidar = box_as_seen(truth, box, key);
    if (!T_box_lidar) continue;
    ObjectReference object;
    object.id = box.id;
    object.class_name = box.class_name;
    object.points = points_in_box(key, ground, *T_box_lidar, box.size);
    if (object.points.empty()) continue;
    object.motion.centroid_k = mean_of(points_at(key, object.points));
    if (static_cast<int>(object.points.size()) < min_points)
      object.excluded = to_string(RegistrationStatus::too_few_points);
    objects.push_back(std::move(object));
  }
  return objects;
}

std::vector<View> views_of(const std::vector<Camera>& cameras, const LidarScan& scan) {
  std::vector<View> views;
  views.reserve(cameras.size());
  for (const Camera& camera : cameras)
    views.push_back({&camera, camera.T_vehicle_camera.inverse() * scan.T_vehicle_lidar});
  return views;
}

bool in_view(const View& view, const Eigen::Vector3d& point_in_lidar) {
  return project(view.camera->model, view.T_camera_lidar * point_in_lidar).has_value();
}

bool in_view(const std::vector<View>& views, const Eigen::Vector3d& point_in_lidar) {
  return std::any_of(views.begin(), views.end(),
                     [&](const View& view) { return in_view(view, point_in_lidar); });
}

std::vector<int> in_scope(const std::vector<ObjectReference>& objects, const LidarScan& key,
                          const Pose& T_ego, const std::vector<Camera>& cameras,
                          const EvaluationOptions& options) {
  const std::vector<View> views = views_of(cameras, key);
  std::vector<int> which;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Eigen::Vector3d& centre = objects[i].motion.centroid_k;
    const bool seen = options.all_around || cameras.empty() || in_view(views, T_ego * centre);
    if (seen && centre.head<2>().norm() <= options.max_range_m)
      which.push_back(static_cast<int>(i));
  }
  return which;
}

LastMotions::LastMotions(const LidarScan& previous, const Pose& T_previous_key, double dt)
    : previous_(without_ground(previous)), T_previous_key_(T_previous_key), dt_(dt) {}

std::vector<Pose> LastMotions::guesses_for(const ObjectReference& object,
                                           const std::vector<ObjectReference>& before) const {
  double nearest_m = 2;  // a car's half: what lies nearer is the same one
  std::vector<Pose> guesses{T_previous_key_, Pose::Identity()};
  for (const ObjectReference& other : before) {
    if (!other.last_motion) continue;
    const Pose T_previous_key =
        exp_se3(Twist(-dt_ * other.last_motion->per_second)) * T_previous_key_;
    const double apart =
        (T_previous_key * object.motion.centroid_k - other.motion.centroid_k).norm();
    if (apart >= nearest_m) continue;
    nearest_m = apart;
    guesses.resize(2);
    guesses.push_back(T_previous_key);
  }
  return guesses;
}

void LastMotions::find(std::vector<ObjectReference>& objects, const std::vector<int>& which,
                       const LidarScan& key, const std::vector<ObjectReference>& before) const {
  tbb::parallel_for(std::size_t{0}, which.size(), [&](std::size_t i) {
    ObjectReference& object = objects[which[i]];
    if (object.last_motion_sought || !object.excluded.empty()) return;
    object.last_motion_sought = true;
    const auto found =
        register_object(points_at(key, object.points), previous_, guesses_for(object, before));
    if (found.status != RegistrationStatus::reliable) return;
    // Back over ground from the key scan to the one before it, both in the frame of the key scan.
    const Pose T_back = T_previous_key_.inverse() * found.T_target_object;
    object.last_motion = LastMotion{-log_se3(T_back) / dt_, dt_, std::hypot(0.02, found.spread_m)};
  });
}

std::vector<ReportedObject> constant_velocity_rows(const std::vector<ObjectReference>& objects,
                                                   const std::vector<int>& which, const Pose& T_ego,
                                                   double dt, std::int64_t told_at) {
  std::vector<ReportedObject> rows;
  for (const int i : which) {
    const ObjectReference& object = objects[i];
    if (!object.last_motion) continue;
    const auto& [per_second, dt_last, sigma_m] = *object.last_motion;
    const Eigen::Vector3d& centre = object.motion.centroid_k;
    const ReferenceMotion step{centre, exp_se3(Twist(dt_last * per_second)), sigma_m};
    ReportedObject row;
    row.stamp = told_at;
    row.points = static_cast<int>(object.points.size());
    row.moving = is_moving(step, Pose::Identity(), dt_last);
    const Eigen::Vector3d moved = exp_se3(Twist(dt * per_second)) * centre;
    row.position = row.middle = T_ego * moved;
    row.velocity = T_ego.linear() * (moved - centre) / dt;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lidar_upsampling
