// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "camera_comparison.h"

#include <filesystem>

#include "drawing.h"
#include "lidar_upsampling/vision/projection.h"
#include "pictures.h"

namespace lidar_upsampling {
namespace {

LidarScan moved(LidarScan scan, const Pose& T) {
  for (Eigen::Vector3f& point : scan.points) point = (T * point.cast<double>()).cast<float>();
  return scan;
}

}  // namespace

std::optional<Stamp> CameraComparison::scan_of(Stamp image) const {
  const auto pair = scan_of_image_.find(image);
  return pair == scan_of_image_.end() ? std::nullopt : std::make_optional(pair->second);
}

void CameraComparison::take(const PlacedScan& scan) {
  for (auto image = waiting_.begin(); image != waiting_.end();) {
    if (scan_of_image_.at(image->first) != scan.scan.stamp) {
      ++image;
      continue;
    }
    compare(scan, image->second);
    image = waiting_.erase(image);
  }
}

void CameraComparison::compare(const PlacedScan& placed, const CameraImage& image) {
  const LidarScan& scan = placed.scan;
  const double dt = seconds_between(scan.stamp, image.stamp) - offset_in_force_s_;
  const LidarScan then = moved(scan, placed.lidar_step ? placed.lidar_step(dt) : Pose::Identity());
  const Pose T_camera_lidar = image.camera.T_vehicle_camera.inverse() * scan.T_vehicle_lidar;
  result_.camera = image.camera;
  result_.share_in_view +=
      static_cast<double>(project_scan(image.camera.model, T_camera_lidar, then.points).size()) /
      static_cast<double>(scan.size());
  ++result_.num_compared;
  if (placed.lidar_step)
    if (const auto scores =
            score_time_offsets({scan, image, placed.lidar_step, placed.before.get()}))
      scores_.push_back(*scores);
  if (overlay_.empty() || image.stamp != drawn_) return;
  result_.overlay = overlay_;
  std::filesystem::create_directories(std::filesystem::path(overlay_).parent_path());
  write_picture(overlay_, overlay(then, image, DepthScale::for_scan(then)));
}

CameraCheck CameraComparison::finish() const {
  CameraCheck check = result_;
  if (check.num_compared > 0) check.share_in_view /= static_cast<double>(check.num_compared);
  TimeOffsetOptions options;
  options.max_sigma_s = options.max_offset_s;  // whoever reads it judges
  check.time_offset = estimate_time_offset(scores_, options);
  return check;
}

}  // namespace lidar_upsampling
