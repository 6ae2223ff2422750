// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_points.h"

#include <algorithm>

namespace lidar_upsampling {
namespace {

// What is followed of a candidate: patches on the picture, and the places that they show, by how
// far they lie beside the scan's points.
struct Patches {
  std::vector<ProjectedPoint> at;
  std::vector<Eigen::Vector3d> beside;  ///< m, lidar frame at k
};

Patches patches_of(const FollowedObject& candidate, const AnchoredScan& anchored,
                   const CameraView& view, const LidarScan& scan, const Pose& T_camera_lidar_a,
                   const Config& config) {
  const CameraModel& camera = view.camera.model;
  const double until_anchor = view.anchor_dt - candidate.time_s;
  const int enough = 2 * config.object_motion.picture.min_points;
  Patches patches{followable_points(anchored, candidate.points, enough), {}};
  const bool on_edges =
      std::any_of(patches.at.begin(), patches.at.end(), [&](const ProjectedPoint& point) {
        return anchored.on_edge[anchored.position[point.index]] != 0;
      });
  Pose T_camera_a_lidar_k = T_camera_lidar_a;
  if (until_anchor != 0 && !candidate.rate.isZero()) {
    T_camera_a_lidar_k = T_camera_lidar_a * exp_se3(Twist(candidate.rate * until_anchor));
    patches.at = reprojected(patches.at, scan, camera, T_camera_a_lidar_k);
  }
  if (!on_edges || !config.point_tracks.off_edges) return patches;
  const std::vector<cv::Point2f> shifts = inward_shifts(anchored, candidate.points, patches.at);
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    ProjectedPoint& at = patches.at[i];
    at.u += shifts[i].x;
    at.v += shifts[i].y;
    const Eigen::Vector3d aside(shifts[i].x / camera.fx, shifts[i].y / camera.fy, 0);
    patches.beside.emplace_back(T_camera_a_lidar_k.linear().transpose() * (at.depth * aside));
  }
  return patches;
}

void add_static_points(PointTracks& tracks, const AnchoredScan& anchored,
                       const std::vector<FollowedObject>& candidates, const LidarScan& scan,
                       const cv::Mat& texture, const StaticPointOptions& options) {
  std::vector<std::uint8_t> unreliable(anchored.points.size()),
      candidate(anchored.points.size(), 0);
  for (std::size_t i = 0; i < unreliable.size(); ++i)
    unreliable[i] = anchored.hidden[i] | anchored.on_edge[i];
  for (const FollowedObject& object : candidates)
    for (const int i : object.points)
      if (anchored.position[i] >= 0) candidate[anchored.position[i]] = 1;
  const auto chosen = choose_static_points(
      {anchored.points, unreliable, candidate, texture.size(), texture}, options);
  add_points(tracks, anchored.points, chosen, scan, kStaticOwner);
}

}  // namespace

void choose_points(CameraView& view, const AnchoredScan& anchored, const cv::Mat& texture,
                   const LidarScan& scan, const Pose& T_camera_lidar_a, bool with_static_points,
                   const Config& config) {
  const PointTrackOptions& options = config.point_tracks;
  for (std::size_t i = 0; i < view.objects.size(); ++i) {
    const Patches patches =
        patches_of(view.objects[i], anchored, view, scan, T_camera_lidar_a, config);
    const auto chosen =
        choose_spread(patches.at, texture, options.max_points_per_object, options.border_px);
    add_points(view.points, patches.at, chosen, scan, static_cast<int>(i), patches.beside);
  }
  if (with_static_points)
    add_static_points(view.points, anchored, view.objects, scan, texture, config.static_points);
}

}  // namespace lidar_upsampling
