// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_points.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace lidar_upsampling {
namespace {

// Where points of the object were on the anchor.
std::vector<ProjectedPoint> at_anchor(std::vector<ProjectedPoint> points,
                                      const FollowedObject& object, const CameraView& view,
                                      const LidarScan& scan, const Pose& T_camera_lidar_a) {
  const double until_anchor = view.anchor_dt - object.time_s;
  if (until_anchor == 0 || object.rate.isZero()) return points;
  return reprojected(points, scan, view.camera.model,
                     T_camera_lidar_a * exp_se3(Twist(object.rate * until_anchor)));
}

SurfaceMap surfaces_of(const AnchoredScan& anchored, const CameraView& view, const LidarScan& scan,
                       const Pose& T_camera_lidar_a, const cv::Size& size) {
  constexpr int kAll = std::numeric_limits<int>::max();
  std::vector<std::vector<ProjectedPoint>> objects(view.objects.size());
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    const FollowedObject& object = view.objects[i];
    objects[i] = at_anchor(followable_points(anchored, object.points, kAll), object, view, scan,
                           T_camera_lidar_a);
  });
  return surfaces_on(anchored, objects, size);
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
  const int enough = 2 * config.object_motion.picture.min_points;
  SurfaceMap surfaces;
  const auto paint_surfaces = [&] {
    if (options.own_surface)
      surfaces = surfaces_of(anchored, view, scan, T_camera_lidar_a, texture.size());
  };
  const auto choose = [&] {
    for (std::size_t i = 0; i < view.objects.size(); ++i) {
      const FollowedObject& object = view.objects[i];
      const auto points = at_anchor(followable_points(anchored, object.points, enough), object,
                                    view, scan, T_camera_lidar_a);
      const auto chosen =
          choose_spread(points, texture, options.max_points_per_object, options.border_px);
      add_points(view.points, points, chosen, scan, static_cast<int>(i));
    }
    if (with_static_points)
      add_static_points(view.points, anchored, view.objects, scan, texture, config.static_points);
  };
  tbb::parallel_invoke(paint_surfaces, choose);
  view.points.surfaces = std::move(surfaces);
}

}  // namespace lidar_upsampling
