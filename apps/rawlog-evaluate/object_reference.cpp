// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "estimates.h"
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

std::vector<ObjectReference> by_clusters(const LidarScan& key) {
  const SceneSegments segments = segment_scan(key);
  std::vector<ObjectReference> objects;
  for (std::size_t i = 0; i < segments.clusters.size(); ++i) {
    if (!is_object(segments.extents[i], segments.clusters[i])) continue;
    ObjectReference object;
    object.id = std::to_string(i);
    object.class_name = "cluster";
    object.points = segments.clusters[i];
    objects.push_back(std::move(object));
  }
  return objects;
}

/// Points of the scan inside a box grown by a tenth of a metre.
std::vector<int> points_in_box(const LidarScan& scan, const Ground& ground, const Pose& T_box_lidar,
                               const Eigen::Vector3d& size) {
  const Eigen::Array3d reach = 0.5 * size.array() + 0.1;
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(scan.size()); ++i) {
    const Eigen::Vector3d in_box = T_box_lidar * scan.points[i].cast<double>();
    const bool on_ground = !ground.is_ground.empty() && ground.is_ground[i] != 0;
    if (!on_ground && (in_box.array().abs() < reach).all()) points.push_back(i);
  }
  return points;
}

std::vector<ObjectReference> by_truth(const ScanSet& scans, const Truth& truth, const Pose& T_ego,
                                      const EvaluationOptions& options) {
  const Ground ground = estimate_ground(scans.key);
  const Stamp stamp = scans.virtual_scan.stamp;
  std::vector<ObjectReference> objects;
  for (const TrueObject& box : truth.objects) {
    const auto T_box_lidar = box_in_scan(truth, box, scans.key);
    const auto motion = true_object_motion(truth, box, scans.key, stamp);
    if (!T_box_lidar || !motion) continue;
    ObjectReference object;
    object.id = box.id;
    object.class_name = box.class_name;
    object.points = points_in_box(scans.key, ground, *T_box_lidar, box.size);
    if (object.points.empty()) continue;
    object.motion = {centroid_of(points_at(scans.key, object.points)), *motion, 0};
    object.moving = box.moves_at(stamp);
    object.speed = ground_speed(object.motion, T_ego, seconds_between(scans.key.stamp, stamp));
    if (static_cast<int>(object.points.size()) < options.min_points_truth)
      object.excluded = to_string(RegistrationStatus::too_few_points);
    objects.push_back(std::move(object));
  }
  return objects;
}

// Normals are of ten neighbours however dense points are: what is judged by stays what it was where
// the method's own registration is made a better one.
Surface surface_to_judge_by(std::vector<Eigen::Vector3f> points) {
  NormalOptions options;
  options.min_radius_m = 0;
  return Surface(std::move(points), options);
}

void register_to_reference(ObjectReference& object, const LidarScan& key, const Surface& surface,
                           const Pose& T_ego, double dt, const EvaluationOptions& options) {
  const auto found = register_object(points_at(key, object.points), surface,
                                     {T_ego, Pose::Identity()}, options.registration);
  object.motion.T_lidar_t_lidar_k = found.T_target_object;
  // Repeated scans of parked cars scatter by 2 cm, whatever the registration says of itself.
  object.motion.sigma_m = std::hypot(0.02, found.spread_m);
  if (found.status != RegistrationStatus::reliable) {
    object.excluded = to_string(found.status);
    return;
  }
  object.moving = is_moving(object.motion, T_ego, dt, options.moving);
  object.speed = ground_speed(object.motion, T_ego, dt);
}

}  // namespace

bool in_view(const Camera& camera, const LidarScan& scan, const Eigen::Vector3d& point_in_lidar) {
  const Eigen::Vector3d in_camera =
      camera.T_vehicle_camera.inverse() * scan.T_vehicle_lidar * point_in_lidar;
  return project(camera.model, in_camera).has_value();
}

bool in_view(const std::vector<Camera>& cameras, const LidarScan& scan,
             const Eigen::Vector3d& point_in_lidar) {
  return std::any_of(cameras.begin(), cameras.end(),
                     [&](const Camera& camera) { return in_view(camera, scan, point_in_lidar); });
}

std::vector<ObjectReference> find_references(const ScanSet& scans, const Truth* truth,
                                             const Pose& T_ego, const std::vector<Camera>& cameras,
                                             const EvaluationOptions& options) {
  auto objects = truth ? by_truth(scans, *truth, T_ego, options) : by_clusters(scans.key);
  const auto out_of_scope = [&](ObjectReference& object) {
    object.motion.centroid_k = centroid_of(points_at(scans.key, object.points));
    const bool seen = options.all_around || cameras.empty() ||
                      in_view(cameras, scans.key, T_ego * object.motion.centroid_k);
    return !seen || object.motion.centroid_k.head<2>().norm() > options.max_range_m;
  };
  objects.erase(std::remove_if(objects.begin(), objects.end(), out_of_scope), objects.end());
  if (truth) return objects;

  const double dt = seconds_between(scans.key.stamp, scans.reference.stamp);
  const Surface surface = surface_to_judge_by(without_ground(scans.reference));
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    register_to_reference(objects[i], scans.key, surface, T_ego, dt, options);
  });
  return objects;
}

}  // namespace lidar_upsampling
