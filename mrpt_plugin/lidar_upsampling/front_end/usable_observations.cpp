// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/front_end/usable_observations.h"

#include <mrpt/system/datetime.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/ego_samples.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

constexpr const char* kNoPose = "its pose on the vehicle is not finite, or beyond 1e8 m";

// The principal point may lie anywhere: settings are free to say so.
bool is_finite(const CameraModel& model) {
  return model.fx > 0 && model.fy > 0 && std::isfinite(model.fx) && std::isfinite(model.fy) &&
         std::isfinite(model.cx) && std::isfinite(model.cy) &&
         std::all_of(model.distortion.begin(), model.distortion.end(),
                     [](double value) { return std::isfinite(value); });
}

const std::pair<RigOverrides, SweepOptions>& as_it_is() {
  static const std::pair<RigOverrides, SweepOptions> nothing = [] {
    SweepOptions sweep;
    sweep.scan_time = ScanTime::none;
    return std::make_pair(RigOverrides(), sweep);
  }();
  return nothing;
}

std::string text_of(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

}  // namespace

std::string to_text(const UnusedCounts::value_type& count) {
  return std::to_string(count.second) + "x: " + count.first;
}

UsableObservations::UsableObservations(TellUnused tell)
    : UsableObservations(as_it_is().first, as_it_is().second, std::move(tell)) {}

std::nullopt_t UsableObservations::refuse(const CObservation& observation, const std::string& kind,
                                          const std::string& more) {
  if (!tell_) return std::nullopt;
  const std::string& label = observation.sensorLabel;
  std::string& text = texts_[label + '\n' + kind];
  if (text.empty()) {
    text = "'" + label + "' passed on unused: " + kind + more;
    if (observation.timestamp != INVALID_TIMESTAMP)
      text += " (first of " + mrpt::system::dateTimeToString(observation.timestamp) + ")";
  }
  tell_(text);
  return std::nullopt;
}

std::optional<LidarScan> UsableObservations::scan(const CObservation& observation) {
  if (const auto defect = stamp_defect_of(observation)) return refuse(observation, *defect);
  std::optional<LidarScan> scan;
  try {
    scan = scan_from_observation(observation);
  } catch (const std::exception& error) {
    return refuse(observation, "it cannot be read: ", one_line(error));
  }
  if (!scan) return {};
  apply(rig_, *scan);
  if (!is_possible(scan->T_vehicle_lidar)) return refuse(observation, kNoPose);
  if (drop_points_without_time(*scan, sweep_) > 0)
    refuse(observation, "some points, which have no time within a second of the scan's");
  if (scan->points.empty()) return refuse(observation, "it has no points");
  return scan;
}

std::optional<CameraImage> UsableObservations::image(
    const mrpt::obs::CObservationImage& observation) {
  if (const auto defect = stamp_defect_of(observation)) return refuse(observation, *defect);
  Camera camera = camera_of(observation);
  apply(rig_, camera);
  if (!is_possible(camera.T_vehicle_camera)) return refuse(observation, kNoPose);
  if (!is_finite(camera.model))
    return refuse(observation, "its calibration has numbers that cannot be");
  CameraImage image;
  try {
    image = image_from_observation(observation);
  } catch (const std::exception& error) {
    return refuse(observation, "it cannot be read: ", one_line(error));
  }
  const cv::Size size = picture_size_.emplace(camera.label, image.gray.size()).first->second;
  if (image.gray.size() != size)
    return refuse(observation, "its picture is of another size than the first, ",
                  text_of(image.gray.size()) + " instead of " + text_of(size));
  apply(rig_, image.camera);
  return image;
}

bool UsableObservations::ego(const CObservation& observation) {
  const auto defect = ego_defect_of(observation);
  if (defect) refuse(observation, *defect);
  return !defect;
}

}  // namespace lidar_upsampling
