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
#include <utility>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

constexpr std::size_t kStampsForRate = 10000;  // all of an hour would be megabytes

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

void LogIndexer::add_observation(const CObservation& observation) {
  StreamInfo& stream = stream_of(observation, index_.streams);
  ++stream.count;
  const auto* const image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation);
  if (image != nullptr && !stream.calibrated()) stream.camera = camera_of(*image);
  if (observation.timestamp == INVALID_TIMESTAMP) return;
  const bool is_seen = stream.kind == StreamKind::lidar || stream.kind == StreamKind::camera;
  if (is_seen || stream.stamps.size() < kStampsForRate)
    stream.stamps.push_back(observation.timestamp);
  if (with_ego_) ego_.add_observation(observation);
}

void LogIndexer::add(const mrpt::serialization::CSerializable& object) {
  ++index_.num_objects;
  if (const auto* const observation = dynamic_cast<const CObservation*>(&object)) {
    add_observation(*observation);
  } else if (const auto* const actions =
                 dynamic_cast<const mrpt::obs::CActionCollection*>(&object)) {
    index_.has_frames = true;
    if (with_ego_) ego_.add_actions(*actions);
  } else if (const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object)) {
    index_.has_frames = true;
    if (with_ego_) ego_.add_frame(*frame);
    for (const auto& in_frame : *frame) add_observation(*in_frame);
  }
}

LogIndex LogIndexer::index() const {
  LogIndex index = index_;
  complete(index);
  return index;
}

LogIndex LogIndexer::take_index() {
  LogIndex index = std::exchange(index_, {});
  complete(index);
  return index;
}

void LogIndexer::complete(LogIndex& index) const {
  for (StreamInfo& stream : index.streams) stream.median_period_s = median_period(stream.stamps);
  index.poses = ego_.poses();
  index.odometry = ego_.odometry();
  index.gnss = ego_.gnss();
}

namespace {

LogIndex indexed(LogIndexer indexer, const LogFile& log,
                 const std::function<void(double)>& progress) {
  if (is_device_or_pipe(log.path))
    throw std::runtime_error(log.path +
                             ": all of the log must be looked through first, and what comes "
                             "through a pipe is read once: save it to a file");
  RawlogReader reader(log, RecordBytes::dropped);
  while (const auto entry = reader.next()) {
    indexer.add(*entry->object);
    if (progress) progress(reader.progress());
  }
  LogIndex index = indexer.take_index();
  index.corruption = reader.damage();
  return index;
}

}  // namespace

LogIndex index_log(const LogFile& log, const std::function<void(double)>& progress) {
  return indexed(LogIndexer(log.path), log, progress);
}

LogIndex index_streams(const LogFile& log, const std::function<void(double)>& progress) {
  return indexed(LogIndexer(log.path, false), log, progress);
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
