// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "densification.h"

#include <mrpt/obs/CObservationImage.h>

#include <stdexcept>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "streams.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

Densification::Densification(const DensifyJob& job, const LogIndex& index, DensifyReport& report)
    : job_(job), report_(report), upsampler_(job.config) {
  const StreamSelection streams = select_streams(index, job.config, labels_of_calibrated(job.rig));
  lidar_label_ = streams.lidar->label;
  std::vector<std::string> labels;
  for (const StreamInfo* camera : streams.cameras) labels.push_back(camera->label);
  camera_labels_ = {labels.begin(), labels.end()};
  upsampler_.expect_scans(streams.lidar->stamps);
  upsampler_.expect_cameras(labels);
  for (const PoseSample& sample : index.poses) upsampler_.ego_motion().add_pose(sample);
  for (const PoseSample& sample : index.odometry) upsampler_.ego_motion().add_odometry(sample);
  for (const GnssSample& sample : index.gnss) upsampler_.ego_motion().add_gnss(sample);
  report.camera_time_offset_ms = job.config.timing.camera_time_offset_ms;
  report.ego_source = to_string(upsampler_.ego_motion().source());
  if (!job.pictures.empty()) pictures_.emplace(job.pictures);
  if (job.config.mode == "offline") ahead_.emplace(job.input, lidar_label_, job.rig);
}

std::optional<VirtualScan> Densification::feed(const CObservation::Ptr& observation) {
  if (!observation) return {};
  if (observation->sensorLabel == lidar_label_ && is_lidar_scan(*observation))
    return noted(feed_scan(observation));
  if (camera_labels_.count(observation->sensorLabel) > 0) return noted(feed_image(*observation));
  return {};
}

std::optional<VirtualScan> Densification::flush() { return noted(upsampler_.flush()); }

std::optional<VirtualScan> Densification::feed_scan(const CObservation::Ptr& observation) {
  ++report_.num_scans;
  last_real_ = observation;
  std::optional<LidarScan> scan;
  try {
    scan = scan_from_observation(*observation);
  } catch (const std::runtime_error& error) {
    report_.warn(std::string("a scan was left out: ") + error.what());
    return {};
  }
  if (scan->points.empty()) {
    report_.warn("a scan without points was left out");
    return {};
  }
  apply(job_.rig, *scan);
  if (pictures_) pictures_->real_scan(*scan);
  look_ahead();
  return upsampler_.insert_scan(std::move(*scan));
}

// The scan at hand is the first of those ahead.
void Densification::look_ahead() {
  if (!ahead_) return;
  const int wanted = report_.num_scans + job_.config.scans_ahead;
  for (; num_expected_ < wanted; ++num_expected_) {
    auto scan = ahead_->next();
    if (!scan) return;
    upsampler_.expect(std::move(*scan));
  }
}

std::optional<VirtualScan> Densification::feed_image(CObservation& observation) {
  auto* image_observation = dynamic_cast<CObservationImage*>(&observation);
  if (image_observation == nullptr) return {};
  ++report_.num_images;
  CameraImage image;
  try {
    image = image_from_observation(*image_observation);
  } catch (const std::runtime_error& error) {
    report_.warn(std::string("an image was left out: ") + error.what());
    return {};
  }
  apply(job_.rig, image.camera);
  if (pictures_) pictures_->image(image);
  return upsampler_.insert_image(image);
}

std::optional<VirtualScan> Densification::noted(std::optional<VirtualScan> scan) {
  if (!scan) return scan;
  report_.add(*scan, job_.keep_rows);
  if (pictures_) pictures_->virtual_scan(*scan);
  return scan;
}

}  // namespace lidar_upsampling
