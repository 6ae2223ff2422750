// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/log_index.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/ego_samples.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

StreamKind kind_of(const CObservation& observation) {
  if (is_lidar_scan(observation)) return StreamKind::lidar;
  if (IS_DERIVED(observation, mrpt::obs::CObservationImage)) return StreamKind::camera;
  if (IS_DERIVED(observation, mrpt::obs::CObservationRobotPose)) return StreamKind::pose;
  if (IS_DERIVED(observation, mrpt::obs::CObservationOdometry)) return StreamKind::odometry;
  if (IS_DERIVED(observation, mrpt::obs::CObservationGPS)) return StreamKind::gnss;
  return StreamKind::other;
}

std::string class_name_of(const CObservation& observation) {
  const std::string full = observation.GetRuntimeClass()->className;
  const auto colon = full.rfind(':');
  return colon == std::string::npos ? full : full.substr(colon + 1);
}

StreamInfo& stream_of(const CObservation& observation, std::vector<StreamInfo>& streams) {
  const std::string class_name = class_name_of(observation);
  for (StreamInfo& stream : streams) {
    if (stream.label == observation.sensorLabel && stream.class_name == class_name) return stream;
  }
  StreamInfo stream;
  stream.label = observation.sensorLabel;
  stream.class_name = class_name;
  stream.kind = kind_of(observation);
  if (const auto* const image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    stream.camera = camera_of(*image);
  }
  return streams.emplace_back(std::move(stream));
}

double median_period(const std::vector<Stamp>& stamps) {
  if (stamps.size() < 2) return 0;
  std::vector<double> periods;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    periods.push_back(seconds_between(stamps[i - 1], stamps[i]));
  }
  return median(std::move(periods));
}

void add_observation(const CObservation& observation, LogIndex& index, EgoSamples& ego) {
  StreamInfo& stream = stream_of(observation, index.streams);
  ++stream.count;
  if (observation.timestamp == INVALID_TIMESTAMP) return;
  stream.stamps.push_back(observation.timestamp);
  ego.add_observation(observation);
}

void add(const mrpt::serialization::CSerializable& object, LogIndex& index, EgoSamples& ego) {
  ++index.num_objects;
  if (const auto* const observation = dynamic_cast<const CObservation*>(&object)) {
    add_observation(*observation, index, ego);
  } else if (const auto* const actions =
                 dynamic_cast<const mrpt::obs::CActionCollection*>(&object)) {
    index.has_frames = true;
    ego.add_actions(*actions);
  } else if (const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object)) {
    index.has_frames = true;
    ego.add_frame(*frame);
    for (const auto& in_frame : *frame) add_observation(*in_frame, index, ego);
  }
}

}  // namespace

const char* to_string(StreamKind kind) {
  constexpr std::array<const char*, 6> kNames{"lidar",    "camera", "pose",
                                              "odometry", "gnss",   "other"};
  return kNames.at(static_cast<std::size_t>(kind));
}

bool StreamInfo::calibrated() const { return camera && is_calibrated(camera->model); }

const StreamInfo* LogIndex::find(const std::string& label, StreamKind kind) const {
  const auto it = std::find_if(streams.begin(), streams.end(), [&](const StreamInfo& stream) {
    return stream.label == label && stream.kind == kind;
  });
  return it == streams.end() ? nullptr : &*it;
}

std::vector<const StreamInfo*> LogIndex::of_kind(StreamKind kind) const {
  std::vector<const StreamInfo*> found;
  for (const StreamInfo& stream : streams) {
    if (stream.kind == kind) found.push_back(&stream);
  }
  return found;
}

LogIndex index_log(const std::string& path, const std::function<void(double)>& progress) {
  RawlogReader reader(path);
  LogIndex index;
  index.path = path;
  EgoSamples ego;
  try {
    while (const auto entry = reader.next()) {
      add(*entry->object, index, ego);
      if (progress) progress(reader.progress());
    }
  } catch (const CorruptRawlog& error) {
    if (index.num_objects == 0) throw;
    index.corruption = error.what();
  }
  for (StreamInfo& stream : index.streams) stream.median_period_s = median_period(stream.stamps);
  index.poses = ego.poses();
  index.odometry = ego.odometry();
  index.gnss = ego.gnss();
  return index;
}

std::string labels_of(const LogIndex& index) {
  std::string text;
  for (const StreamInfo& stream : index.streams) {
    text += (text.empty() ? "" : ", ") + stream.label + " (" + to_string(stream.kind) + ")";
  }
  return text.empty() ? "no observation at all" : text;
}

std::string describe(const LogIndex& index) {
  std::string table;
  for (const StreamInfo& stream : index.streams) {
    char line[256];
    const double rate = stream.median_period_s > 0 ? 1. / stream.median_period_s : 0.;
    std::snprintf(line, sizeof line, "%-16s %-26s %-8s %7zu at %6.2f Hz", stream.label.c_str(),
                  stream.class_name.c_str(), to_string(stream.kind), stream.count, rate);
    table += line;
    if (stream.camera) {
      const CameraModel& model = stream.camera->model;
      table += ", " + std::to_string(model.width) + " x " + std::to_string(model.height) +
               (stream.calibrated() ? "" : ", not calibrated");
    }
    table += '\n';
  }
  return table;
}

}  // namespace lidar_upsampling
