// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/front_end/pose_input.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <stdexcept>

#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

// The first observation of the label, be it inside a sensory frame.
CObservation::Ptr first_of(const std::string& label, const RawlogEntry& entry) {
  if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry.object))
    return frame->getObservationBySensorLabel(label);
  auto observation = std::dynamic_pointer_cast<CObservation>(entry.object);
  return observation && observation->sensorLabel == label ? observation : nullptr;
}

Pose T_vehicle_sensor(const LogIndex& index, const std::string& label, const RigOverrides& rig) {
  const auto lidar = rig.T_vehicle_lidar.find(label);
  if (lidar != rig.T_vehicle_lidar.end()) return lidar->second;
  if (is_device_or_pipe(index.path))
    throw std::runtime_error(index.path + ": where '" + label +
                             "' sits, whose poses the poses_file tells ([ego_motion] poses_of), "
                             "takes a second look, and a pipe cannot be read twice: save it to a "
                             "file, or give [lidar." +
                             label + "] pose");
  RawlogReader reader(LogFile(index.path, true), RecordBytes::dropped);
  while (const auto entry = reader.next()) {
    const CObservation::Ptr observation = first_of(label, *entry);
    if (!observation) continue;
    mrpt::poses::CPose3D pose;
    observation->getSensorPose(pose);
    Camera sensor;
    sensor.label = label;
    sensor.T_vehicle_camera = from_mrpt(pose);
    apply(rig, sensor);
    return sensor.T_vehicle_camera;
  }
  throw std::runtime_error(index.path + ": nothing is labelled '" + label +
                           "' ([ego_motion] poses_of); the log holds " + labels_of(index));
}

// By custom the poses of a KITTI file are those of the first camera.
std::string sensor_of(const PoseFileOptions& file, const LogIndex& index) {
  if (!file.sensor.empty() || format_of(file) != PoseFileFormat::kitti) return file.sensor;
  const auto cameras = index.of_kind(StreamKind::camera);
  return cameras.empty() ? "" : cameras.front()->label;
}

std::string span_of(Stamp first, Stamp last) { return to_text(first) + " to " + to_text(last); }

void check_times(const PoseFileOptions& file, const std::vector<PoseSample>& poses,
                 const std::vector<Stamp>& scans) {
  if (scans.empty()) return;
  const auto [first, last] = std::minmax_element(
      poses.begin(), poses.end(),
      [](const PoseSample& a, const PoseSample& b) { return a.stamp < b.stamp; });
  const auto [first_scan, last_scan] = std::minmax_element(scans.begin(), scans.end());
  if (first->stamp > *last_scan || last->stamp < *first_scan)
    throw std::runtime_error(file.path + ": its poses are of another time, " +
                             span_of(first->stamp, last->stamp) + " (UNIX s), than the scans, " +
                             span_of(*first_scan, *last_scan));
}

}  // namespace

void take_poses_from_file(const Config& config, const RigOverrides& rig, LogIndex& index) {
  const PoseFileOptions& file = config.pose_file;
  if (file.path.empty()) return;
  const EgoSource source = config.ego_motion.source;
  if (source != EgoSource::automatic && source != EgoSource::poses)
    throw std::invalid_argument(std::string("[ego_motion] source = ") + to_string(source) +
                                ": a poses_file needs source = poses or auto");
  const auto lidars = index.of_kind(StreamKind::lidar);
  const StreamInfo* lidar = index.find(config.lidar_label, StreamKind::lidar);
  if (lidar == nullptr && !lidars.empty()) lidar = lidars.front();
  const std::vector<Stamp> scans = lidar == nullptr ? std::vector<Stamp>{} : lidar->stamps;
  const std::string sensor = sensor_of(file, index);
  index.poses = read_pose_file(
      file, scans, sensor.empty() ? Pose::Identity() : T_vehicle_sensor(index, sensor, rig));
  check_times(file, index.poses, scans);
}

}  // namespace lidar_upsampling
