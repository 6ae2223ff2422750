// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// Real scans, as LidarUpsampler takes them up.
#include <tbb/parallel_invoke.h>

#include <utility>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/level_frame.h"
#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/objects/object_points.h"
#include "lidar_upsampling/objects/road_users.h"
#include "lidar_upsampling/partly_hidden.h"
#include "lidar_upsampling/prepared_scan.h"
#include "lidar_upsampling/scan/sweep.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/upsampler.h"

namespace lidar_upsampling {
namespace {

ScanObject make_object(const PreparedScan& prepared, std::vector<int> points,
                       std::string class_name, double length) {
  ScanObject object;
  object.centroid = mean_of(points_at(prepared.scan, points));
  if (prepared.is_sweep) object.time_s = mean_time(prepared.scan.time_s, points);
  object.points = std::move(points);
  object.class_name = std::move(class_name);
  object.length = length;
  return object;
}

// Those clusters that may be road users, seen by a camera or not, and the others.
void sort_clusters(const Config& config, PreparedScan& prepared) {
  const LidarScan& scan = prepared.scan;
  const SceneSegments& segments = prepared.segments;
  const auto why = why_no_road_users(scan, segments, config.detector.clusters);
  for (std::size_t i = 0; i < why.size(); ++i) {
    const ClusterExtent& extent = segments.extents[i];
    if (why[i] == nullptr)
      prepared.objects.push_back(
          make_object(prepared, segments.clusters[i], class_by_size(extent), extent.length));
    else
      prepared.other_clusters.push_back({extent.centroid.cast<double>(),
                                         {extent.length, extent.width, extent.height()},
                                         segments.clusters[i].size(),
                                         why[i]});
  }
}

// What a scan shows by itself. @return the stages' times.
std::vector<StageTime> look_at(const Config& config, PreparedScan& prepared) {
  const LidarScan& scan = prepared.scan;
  std::vector<StageTime> times, of_beams;
  const auto sort_points = [&] {
    {
      const Stopwatch watch(times, "ground and clusters");
      prepared.segments = segment_scan(scan, config.segments);
    }
    {
      const Stopwatch watch(times, "seen space");
      prepared.seen =
          std::make_shared<const SeenSpace>(scan.points, prepared.segments.vertical_step_deg);
    }
    const Stopwatch watch(times, "candidates");
    sort_clusters(config, prepared);
  };
  const auto find_beams = [&] {
    if (config.resample != "beam") return;
    const Stopwatch watch(of_beams, "beams");
    const bool is_tilted = !prepared.R_level_lidar.isIdentity(0);
    LidarScan as_measured;
    if (is_tilted) {
      as_measured = scan;
      put_in_axes(as_measured, prepared.R_level_lidar.transpose());
    }
    prepared.resampler =
        std::make_unique<const BeamResampler>(is_tilted ? as_measured : scan, config.resampling);
  };
  tbb::parallel_invoke(sort_points, find_beams);
  times.insert(times.end(), of_beams.begin(), of_beams.end());
  return times;
}

// What lies in a detector's boxes on a picture that shows the scan.
// @param T_camera_lidar ego-motion until the picture included.
std::vector<ScanObject> objects_of_boxes(const PreparedScan& prepared, const CameraImage& image,
                                         const Pose& T_camera_lidar, Detector& detector,
                                         const Config& config) {
  const LidarScan& scan = prepared.scan;
  const auto visible = visible_points(anchor_scan(scan, image.camera.model, T_camera_lidar));
  std::vector<ScanObject> objects;
  for (const Detection& detection : detector.detect(image)) {
    auto points =
        select_object_points(scan, visible, prepared.segments, detection.box, config.object_points);
    if (!points) continue;
    const double length = cluster_extent(scan.points, {}, *points).length;
    objects.push_back(make_object(prepared, std::move(*points), detection.class_name, length));
    objects.back().external_id = detection.external_track;
  }
  return objects;
}

}  // namespace

void LidarUpsampler::straighten(LidarScan& scan, const std::vector<float>& times,
                                const Twist& rate) const {
  deskew(scan, times, [&](double time) {
    const auto step = ego_motion_.step(shifted(scan.stamp, time), scan.stamp);
    return step ? between_sensors(step->T_to_from, scan.T_vehicle_lidar)
                : exp_se3(Twist(-time * rate));
  });
}

std::unique_ptr<PreparedScan> LidarUpsampler::prepared(LidarScan scan, const PreparedScan* before) {
  auto result = std::make_unique<PreparedScan>();
  const std::vector<float> times =
      point_times(scan, config_.sweep, turn_s(config_.sweep, expected_scans_, scan_period_s_));
  result->R_level_lidar = level_rotation(scan.T_vehicle_lidar);
  put_in_axes(scan, result->R_level_lidar);
  const auto as_measured = times.empty() ? std::vector<Eigen::Vector3f>{} : scan.points;
  straighten(scan, times, before != nullptr ? before->motion.rate : Twist(Twist::Zero()));
  result->scan = std::move(scan);
  result->is_sweep = !times.empty();
  const auto join = [&] {
    if (before == nullptr) return;
    step_between_scans(*before, *result);
    if (!times.empty() && result->motion.is_measured &&
        !given_step(before->scan, result->scan.stamp)) {
      result->scan.points = as_measured;  // once more, by the rate that it showed itself
      straighten(result->scan, times, result->motion.rate);
    }
    result->T_rest_lidar = before->T_rest_lidar * result->T_scan_before.inverse();
  };
  std::vector<StageTime> of_look;
  const auto look = [&] { of_look = look_at(config_, *result); };
  if (times.empty()) {
    tbb::parallel_invoke(join, look);
  } else {  // points that the motion straightens wait for it
    join();
    look();
  }
  timing_.insert(timing_.end(), of_look.begin(), of_look.end());
  return result;
}

void LidarUpsampler::expect(LidarScan scan) {
  const PreparedScan* before = to_come_.empty() ? key_.get() : to_come_.back().get();
  if (before != nullptr && scan.stamp <= before->scan.stamp) return;
  to_come_.push_back(prepared(std::move(scan), before));
}

// A detector's boxes take the place of the clusters, on the picture that shows the scan.
void LidarUpsampler::take_up(const Picture* anchor) {
  if (is_taken_up_) return;
  const Stopwatch watch(timing_, "tracks");
  if (detector_ && anchor != nullptr) {
    const Pose T_camera_lidar =
        T_camera_lidar_of(anchor->image.camera, key_->scan.T_vehicle_lidar) *
        ego_step(anchor->instant).T_to_from;
    key_->objects = objects_of_boxes(*key_, anchor->image, T_camera_lidar, *detector_, config_);
    key_->other_clusters.clear();
  }
  track_of_ = take_up_scan(store_, key_->objects, key_->tracked(), config_.object_tracks);
  if (config_.object_motion.world_tracks)
    take_up_hidden(*key_, store_, track_of_, config_.object_tracks);
  is_taken_up_ = true;
  std::vector<ScanToCome> to_come;
  for (const auto& next : to_come_) to_come.push_back({next->objects, next->tracked()});
  if (!to_come.empty()) look_ahead(store_, to_come, config_.object_tracks);
}

}  // namespace lidar_upsampling
