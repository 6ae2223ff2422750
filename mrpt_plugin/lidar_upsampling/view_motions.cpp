// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <algorithm>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/objects/covered_points.h"
#include "lidar_upsampling/objects/object_motion.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

Box2d box_of(const CameraModel& camera, const LidarScan& scan, const std::vector<int>& points,
             const Pose& T_camera_t_lidar_k) {
  Box2d box{1e9, 1e9, -1e9, -1e9};
  for (const int i : points) {
    const auto pixel = project(camera, T_camera_t_lidar_k * scan.points[i].cast<double>());
    if (!pixel) continue;
    box.left = std::min(box.left, pixel->x());
    box.right = std::max(box.right, pixel->x());
    box.top = std::min(box.top, pixel->y());
    box.bottom = std::max(box.bottom, pixel->y());
  }
  return box.right < box.left ? Box2d{} : box;
}

// Where moving objects are at the image.
CoverMap cover_map(const CameraView& view, const std::vector<ObjectMotion>& motions,
                   const LidarScan& scan, const MotionQuery& query) {
  constexpr double kFinest_px = 5;
  const Neighbourhood sampling = sampling_of(scan, query.camera);
  CoverMap map(query.camera.width, query.camera.height,
               std::max(kFinest_px, sampling.half_width_px),
               std::max(kFinest_px, sampling.half_height_px));
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!moves(motions[i])) continue;
    const Pose T_camera_t_lidar_k = query.T_camera_lidar * motions[i].T_lidar_t_lidar_k;
    for (const int index : view.candidates[i].points) {
      const Eigen::Vector3d point = T_camera_t_lidar_k * scan.points[index].cast<double>();
      if (const auto pixel = project(query.camera, point))
        map.add(*pixel, point.z(), static_cast<int>(i));
    }
  }
  return map;
}

// Pieces of one vehicle do not cover each other: what moves alike stays side by side.
std::vector<std::uint8_t> companions_of(std::size_t i, const std::vector<ObjectMotion>& motions) {
  constexpr double kAlike = 1.5;  // m/s
  std::vector<std::uint8_t> alike(motions.size(), 0);
  for (std::size_t j = 0; j < motions.size(); ++j)
    alike[j] =
        i == j || (motions[i].velocity_lidar_k - motions[j].velocity_lidar_k).norm() < kAlike;
  return alike;
}

// The points were put on the anchor picture under `rate`; what was found is the motion since then,
// so the part between scan and anchor follows from it at constant velocity.
Pose over_whole_interval(const Pose& T_mov, const Twist& rate, double anchor_dt, double dt) {
  if (anchor_dt == 0 || dt - anchor_dt <= 0) return T_mov;
  const Pose since_anchor = T_mov * exp_se3(Twist(rate * anchor_dt)).inverse();
  return exp_se3(Twist(log_se3(since_anchor) * (dt / (dt - anchor_dt))));
}

}  // namespace

std::vector<ObjectMotion> estimate_motions(CameraView& view, const Picture& picture,
                                           const LidarScan& key_scan, const Pose& T_lidar_t_lidar_k,
                                           const Config& config) {
  MotionQuery query;
  query.camera = view.camera.model;
  query.T_camera_lidar = T_camera_lidar_of(view.camera, key_scan.T_vehicle_lidar);
  query.T_lidar_t_lidar_k = T_lidar_t_lidar_k;
  query.dt = seconds_between(key_scan.stamp, picture.instant);

  const std::size_t count = view.candidates.size();
  std::vector<ObjectMotion> motions(count);
  std::vector<MotionQuery> queries(count, query);
  std::vector<std::vector<Correspondence>> pairs(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const Candidate& candidate = view.candidates[i];
    MotionQuery& own = queries[i];
    own.centroid_lidar_k = candidate.centroid;
    if (candidate.known) own.known_evidence = evidence_of_motion(*candidate.known);
    own.prior = expect_motion(candidate.known, key_scan.stamp, view.R_rest_lidar_k.transpose(),
                              candidate.centroid, query.dt, config.object_motion.prior);
    pairs[i] = correspondences_of(view.points, static_cast<int>(i));
    motions[i] = estimate_object_motion(pairs[i], own, config.object_motion);
  });

  const CoverMap map = cover_map(view, motions, key_scan, query);
  std::vector<std::vector<std::uint8_t>> companions(count);
  for (std::size_t i = 0; i < count; ++i) companions[i] = companions_of(i, motions);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    Candidate& candidate = view.candidates[i];
    ObjectMotion& motion = motions[i];
    if (config.object_motion.prior.enabled) {
      const auto uncovered = without_covered(
          pairs[i], map, query.camera,
          query.T_camera_lidar * T_lidar_t_lidar_k * queries[i].prior.T_mov, companions[i]);
      if (uncovered.size() < pairs[i].size())
        motion = estimate_object_motion(uncovered, queries[i], config.object_motion);
    }
    if (motion.status == MotionStatus::moving) {
      const Pose T_mov =
          over_whole_interval(motion.T_mov, candidate.rate, view.anchor_dt, query.dt);
      set_motion(motion, T_lidar_t_lidar_k * T_mov, queries[i]);
      candidate.rate = log_se3(T_mov) / query.dt;
    }
    motion.track_id = candidate.track_id;
    motion.class_name = candidate.detection.class_name;
    motion.camera_label = view.camera.label;
    motion.points = candidate.points;
    motion.box = box_of(query.camera, key_scan, candidate.points,
                        query.T_camera_lidar * motion.T_lidar_t_lidar_k);
  });
  return motions;
}

}  // namespace lidar_upsampling
