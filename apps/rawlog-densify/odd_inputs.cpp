// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "odd_inputs.h"

#include <mrpt/system/datetime.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

std::string listed(const std::set<std::string>& labels) {
  std::string text;
  for (const std::string& label : labels) text += (text.empty() ? "" : ", ") + label;
  return text.empty() ? "none" : text;
}

// As the detector reads them.
std::set<std::string> labels_in_boxes(const std::string& path) {
  std::set<std::string> labels;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> fields = comma_separated(line, " \t\r\"");
    if (fields.size() < 8 || fields[0].rfind('#', 0) == 0 || fields[1] == "stamp") continue;
    labels.insert(fields[0]);
  }
  return labels;
}

void warn_of_boxes(const std::string& path, const std::set<std::string>& cameras,
                   DensifyReport& report) {
  const std::set<std::string> boxes = labels_in_boxes(path);
  const bool any_used = std::any_of(boxes.begin(), boxes.end(), [&](const std::string& label) {
    return cameras.count(label) > 0;
  });
  if (any_used) return;
  report.warn(path + (boxes.empty()
                          ? " holds no boxes: there are no object candidates"
                          : " holds boxes of " + listed(boxes) + " alone, but the cameras are " +
                                listed(cameras) + ": there are no object candidates"));
}

}  // namespace

bool StampWatch::note(const mrpt::obs::CObservation& observation) {
  constexpr double kMostAhead_s = 60;
  const Stamp stamp = observation.timestamp;
  if (stamp == INVALID_TIMESTAMP) return true;
  const auto [last, is_first] = last_.emplace(
      std::pair(observation.sensorLabel, std::string(observation.GetRuntimeClass()->className)),
      stamp);
  if (is_first) return true;
  const double step_s = seconds_between(last->second, stamp);
  last->second = stamp;
  if (step_s < 0 || step_s > kMostAhead_s)
    report_.warn(
        "'" + observation.sensorLabel +
            "': the clock jumps back, or more than a minute ahead: virtual scans are "
            "missing or wrong there",
        "by " + std::to_string(step_s) + " s, to " + mrpt::system::dateTimeToString(stamp));
  return step_s != 0;
}

void warn_of_unused(const DensifyJob& job, const std::set<std::string>& labels,
                    const std::set<std::string>& cameras, DensifyReport& report) {
  const auto check = [&](const std::string& kind, const std::string& label) {
    if (labels.count(label) == 0)
      report.warn("settings [" + kind + "." + label + "] are of no use: the log's labels are " +
                  listed(labels));
  };
  for (const auto& [label, camera] : job.rig.cameras) check("camera", label);
  for (const auto& [label, pose] : job.rig.T_vehicle_lidar) check("lidar", label);
  if (job.config.detector.type == DetectorOptions::Type::csv)
    warn_of_boxes(job.config.detector.csv.path, cameras, report);
}

void warn_of_nothing_made(const DensifyJob& job, DensifyReport& report) {
  const DetectorOptions& detector = job.config.detector;
  if (detector.type == DetectorOptions::Type::csv && report.object_status.empty())
    report.warn(
        detector.csv.path +
        ": no object was met in its boxes: of each scan those of the image nearest to it are "
        "used, with that image's stamp to within detector.stamp_tolerance_ms");
  if (report.num_virtual_scans > 0) return;
  std::string cause =
      "no image lies behind a real scan and further than timing.pair_tolerance_ms from all of "
      "them: is the camera faster than the LiDAR, and do their clocks agree (rawlog-densify "
      "--check)?";
  if (report.num_scans == 0)
    cause = "there was no scan to use";
  else if (report.num_images == 0)
    cause = "there was no image to use";
  report.warn("no virtual scan was made: " + cause);
}

}  // namespace lidar_upsampling
