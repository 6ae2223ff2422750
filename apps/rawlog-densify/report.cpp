// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report.h"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>

namespace lidar_upsampling {
namespace {

std::optional<ObjectBox> box_of(int track, const std::vector<ObjectBox>& boxes) {
  for (const ObjectBox& box : boxes)
    if (box.track_id == track) return box;
  return {};
}

std::string fixed(double value, int width, int digits) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(digits);
  text.width(width);
  text << value;
  return text.str();
}

// Why points lie on the sensor's beams, or not.
std::string resampling_line(const std::map<std::string, std::size_t>& resampling) {
  const std::map<std::string, const char*> meanings{
      {"done", "on the sensor's beams"},
      {"little_motion", "as moved, which was little"},
      {"no_beams", "as moved, as the scan tells no beams (rings of a spinning LiDAR)"},
      {"none", "as moved"}};
  std::ostringstream text;
  for (const auto& [status, count] : resampling)
    text << (text.tellp() > 0 ? ", " : "points            ") << count << "x "
         << meanings.at(status);
  if (text.tellp() > 0) text << '\n';
  return text.str();
}

// Objects, counted anew at each image, by what became of them.
std::string status_lines(const std::map<std::string, std::size_t>& object_status) {
  static const std::map<std::string, const char*> meanings{
      {"moving", "measured on the picture to move"},
      {"stationary", "measured on the picture to stand"},
      {"predicted", "moved on by their tracks, as the picture tells nothing"},
      {"too_few_points",
       "left standing: out of every camera's view, or too small or plain to be followed"},
      {"no_consensus", "left standing, as their points agree on no motion"}};
  std::ostringstream text;
  if (!object_status.empty()) text << "objects, each anew at every image\n";
  for (const auto& [status, count] : object_status)
    text << "  " << std::left << std::setw(16) << status << std::setw(8) << count
         << meanings.at(status) << '\n';
  return text.str();
}

// At how many images objects that move were measured, or else.
std::string sights_line(const std::map<std::string, std::size_t>& object_status) {
  const auto count = [&](MotionStatus status) {
    const auto found = object_status.find(to_string(status));
    return found == object_status.end() ? std::size_t{0} : found->second;
  };
  const std::size_t measured = count(MotionStatus::moving);
  const std::size_t predicted = count(MotionStatus::predicted);
  const std::size_t left = count(MotionStatus::too_few_points) + count(MotionStatus::no_consensus);
  const std::size_t all = measured + predicted;
  if (all + left == 0) return {};
  std::ostringstream text;
  text << "sights of movers  ";
  if (all > 0)
    text << fixed(100. * static_cast<double>(measured) / static_cast<double>(all), 1, 0)
         << " % measured on the picture, "
         << fixed(100. * static_cast<double>(predicted) / static_cast<double>(all), 1, 0)
         << " % predicted by their tracks; ";
  text << left << " of objects that the picture told nothing of were left standing\n";
  return text.str();
}

}  // namespace

void DensifyReport::add(const VirtualScan& scan) {
  ++num_virtual_scans;
  if (scan.ego_extrapolated) ++num_extrapolated;
  last_stamp = scan.scan.stamp;
  last_rows.clear();
  T_rest_lidar_last = scan.T_rest_lidar_t;
  ++resampling[to_string(scan.resampling)];
  const std::vector<ObjectBox> boxes = rows ? object_boxes(scan) : std::vector<ObjectBox>{};
  for (const ObjectMotion& object : scan.objects) {
    ++object_status[to_string(object.status)];
    tracks.insert(object.track_id);
    if (moves(object)) moving_tracks.insert(object.track_id);
    ReportRow row{scan.scan.stamp, object.points.size(), object, {}, scan.T_rest_lidar_t};
    row.object.points = {};
    last_rows.push_back(row);
    row.box = box_of(object.track_id, boxes);
    if (rows) rows->add(row);
  }
  if (rows)
    for (const OtherCluster& cluster : scan.other_clusters) rows->add(scan.key_stamp, cluster);
  add(scan.timing);
}

void DensifyReport::add(const std::vector<StageTime>& times) {
  for (const StageTime& time : times) {
    if (stage_ms.find(time.stage) == stage_ms.end()) stage_order.emplace_back(time.stage);
    stage_ms[time.stage].add(time.ms);
  }
}

void DensifyReport::warn(const std::string& kind, const std::string& detail) {
  Warning& warning = warnings[kind];
  if (++warning.count == 1) warning.first = detail;
}

DensifyReport DensifyReport::begun_anew() const {
  DensifyReport report;
  report.input = input;
  report.output = output;
  report.mode = mode;
  report.ego_source = ego_source;
  report.detector = detector;
  report.carrier = carrier;
  report.camera_time_offset_ms = camera_time_offset_ms;
  report.hindsight = hindsight;
  return report;
}

std::map<std::string, std::size_t> DensifyReport::told_warnings() const {
  std::map<std::string, std::size_t> told;
  for (const auto& [kind, warning] : warnings)
    told[kind + (warning.first.empty() ? "" : ": " + warning.first) +
         (warning.first.empty() || warning.count == 1 ? "" : " (the first of them)")] =
        warning.count;
  return told;
}

std::string summary(const DensifyReport& report) {
  std::ostringstream text;
  text << "input             " << report.input << '\n'
       << "output            " << report.output << '\n'
       << "mode              " << report.mode << (report.hindsight ? ", with scans to come" : "")
       << '\n'
       << "ego-motion        " << report.ego_source << '\n'
       << "object candidates " << report.detector << '\n'
       << "real scans        " << report.num_scans << '\n'
       << "images            " << report.num_images << '\n'
       << "virtual scans     " << report.num_virtual_scans
       << (report.carrier.empty() ? "" : " (as " + report.carrier + ")") << '\n'
       << "objects tracked   " << report.tracks.size() << ", of them moving "
       << report.moving_tracks.size() << '\n';
  text << status_lines(report.object_status) << sights_line(report.object_status)
       << resampling_line(report.resampling);
  if (report.num_extrapolated > 0)
    text << "ego-motion was extrapolated for " << report.num_extrapolated << " virtual scans\n";
  if (!report.stage_order.empty()) text << "stage                   runs  median ms  p95 ms\n";
  for (const std::string& stage : report.stage_order) {
    const Durations& times = report.stage_ms.at(stage);
    text << "  " << stage << std::string(20 - std::min<std::size_t>(19, stage.size()), ' ')
         << fixed(static_cast<double>(times.count()), 6, 0) << fixed(times.quantile(0.5), 11, 1)
         << fixed(times.quantile(0.95), 8, 1) << '\n';
  }
  for (const auto& [warning, count] : report.told_warnings())
    text << "warning (" << count << "x): " << warning << '\n';
  return text.str();
}

}  // namespace lidar_upsampling
