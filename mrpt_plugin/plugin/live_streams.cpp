// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/live_streams.h"

#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
#include <stdexcept>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

LiveStreams::LiveStreams(const Config& config, const RigOverrides& rig)
    : config_(config), rig_(rig), lidar_label_(config.lidar_label) {}

Role LiveStreams::role_of(const CObservation& observation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string& label = observation.sensorLabel;
  if (observation.timestamp == INVALID_TIMESTAMP) return Role::other;
  if (is_lidar_scan(observation)) {
    if (lidar_label_.empty()) lidar_label_ = label;
    if (label == lidar_label_) return Role::scan;
    if (label == config_.virtual_label(lidar_label_))
      throw std::runtime_error("the sources hold virtual scans labelled '" + label +
                               "' already; remove them with rawlog-decimate --keep-every 0, or "
                               "choose another output_label");
  } else if (is_camera(observation)) {
    camera_labels_.insert(label);
    return Role::image;
  }
  other_labels_.insert(label);
  return Role::other;
}

std::string LiveStreams::seen() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string text = "LiDAR '" + lidar_label_ + "', cameras";
  for (const std::string& label : camera_labels_) text += " '" + label + "'";
  text += ", others";
  for (const std::string& label : other_labels_) text += " '" + label + "'";
  return text;
}

bool LiveStreams::is_camera(const CObservation& observation) const {
  const auto* const image = dynamic_cast<const CObservationImage*>(&observation);
  if (image == nullptr) return false;
  const std::vector<std::string>& wanted = config_.camera_labels;
  const bool is_named =
      std::find(wanted.begin(), wanted.end(), observation.sensorLabel) != wanted.end();
  if (!is_named && !wanted.empty()) return false;
  if (camera_labels_.count(observation.sensorLabel) > 0) return true;
  Camera camera = camera_of(*image);
  apply(rig_, camera);
  if (is_calibrated(camera.model)) return true;
  if (is_named)
    throw std::runtime_error("the images of '" + camera.label +
                             "' have no calibration; give it in a section [camera." + camera.label +
                             "] with fx_px, fy_px, cx_px, cy_px and pose");
  return false;
}

}  // namespace lidar_upsampling
