// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan_objects.h"

#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/objects/object_points.h"
#include "lidar_upsampling/objects/road_users.h"

namespace lidar_upsampling {
namespace {

ScanObject make_object(const LidarScan& scan, std::vector<int> points, std::string class_name,
                       double length, bool is_sweep) {
  ScanObject object;
  object.centroid = mean_of(points_at(scan, points));
  if (is_sweep) object.time_s = mean_time(scan.time_s, points);
  object.points = std::move(points);
  object.class_name = std::move(class_name);
  object.length = length;
  return object;
}

}  // namespace

SortedClusters sorted_clusters(const LidarScan& scan, const SceneSegments& segments,
                               const Config& config) {
  SortedClusters result;
  const bool is_sweep = config.sweep.scan_time != ScanTime::none;
  const auto why = why_no_road_users(scan, segments, config.detector.clusters);
  for (std::size_t i = 0; i < why.size(); ++i) {
    const ClusterExtent& extent = segments.extents[i];
    if (why[i] == nullptr)
      result.objects.push_back(
          make_object(scan, segments.clusters[i], class_by_size(extent), extent.length, is_sweep));
    else
      result.others.push_back({extent.centroid.cast<double>(),
                               {extent.length, extent.width, extent.height()},
                               segments.clusters[i].size(),
                               why[i]});
  }
  return result;
}

std::vector<ScanObject> objects_of_boxes(const LidarScan& scan, const SceneSegments& segments,
                                         const CameraImage& image, const Pose& T_camera_lidar,
                                         Detector& detector, const Config& config) {
  const auto visible = visible_points(anchor_scan(scan, image.camera.model, T_camera_lidar));
  const bool is_sweep = config.sweep.scan_time != ScanTime::none;
  std::vector<ScanObject> objects;
  for (const Detection& detection : detector.detect({image, &scan, &segments, T_camera_lidar})) {
    auto points =
        select_object_points(scan, visible, segments, detection.box, config.object_points);
    if (!points) continue;
    const double length = cluster_extent(scan.points, {}, *points).length;
    objects.push_back(
        make_object(scan, std::move(*points), detection.class_name, length, is_sweep));
    objects.back().external_id = detection.external_track;
  }
  return objects;
}

}  // namespace lidar_upsampling
