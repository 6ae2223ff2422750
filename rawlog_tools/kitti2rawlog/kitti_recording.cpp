// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_recording.h"

#include <filesystem>
#include <map>
#include <stdexcept>

#include "kitti2rawlog/kitti_calibration.h"
#include "kitti2rawlog/kitti_frames.h"
#include "kitti2rawlog/kitti_label_tracks.h"
#include "kitti2rawlog/kitti_sequence.h"
#include "kitti2rawlog/kitti_tracklets.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"

namespace fs = std::filesystem;

namespace lidar_upsampling::kitti {
namespace {

void check_folder(const std::string& folder) {
  if (!fs::is_directory(folder)) throw std::runtime_error("there is no folder " + folder);
}

const Camera& camera_numbered(const Calibration& calibration, int number) {
  const auto camera = calibration.cameras.find(number);
  if (camera == calibration.cameras.end()) {
    throw std::runtime_error("no calibration of camera " + std::to_string(number));
  }
  return camera->second;
}

SensorFrames drive_frames(const std::string& drive, const std::string& name,
                          std::vector<std::string> extensions, const FrameRange& range) {
  const std::string folder = drive + "/" + name;
  return {name, list_frames(folder + "/data", read_stamps(folder + "/timestamps.txt"),
                            {10, std::move(extensions)}, range)};
}

// The frames of a sequence's poses are their rows.
SensorFrames pose_rows(const std::string& name, std::size_t num_rows, const FrameStamps& stamps,
                       const FrameRange& range) {
  SensorFrames sensor{name, {}};
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const int number = static_cast<int>(i);
    if (number < range.first || number > range.last) continue;
    if (i < num_rows) {
      sensor.files.frames.push_back({number, *stamps[i], {}});
    } else {
      sensor.files.missing.push_back(number);
    }
  }
  return sensor;
}

void read_sequence_poses(const fs::path& sequence, const FrameStamps& stamps,
                         const FrameRange& range, const Pose& T_vehicle_camera_0,
                         Recording& recording) {
  const std::string name = "poses/" + sequence.filename().string() + ".txt";
  const fs::path file = sequence.parent_path().parent_path() / name;
  if (!fs::exists(file)) return;
  const std::vector<Pose> poses = read_poses(file.string(), T_vehicle_camera_0);
  recording.pose_frames = pose_rows(name, poses.size(), stamps, range);
  for (const Frame& frame : recording.pose_frames.files.frames) {
    recording.poses.push_back({frame.stamp, poses[static_cast<std::size_t>(frame.number)]});
  }
}

std::string label_file_of(const std::string& drive) {
  const std::string tracklets = drive + "/tracklet_labels.xml", labels = drive + "/label_02.txt";
  if (fs::is_regular_file(tracklets)) return tracklets;
  if (fs::is_regular_file(labels)) return labels;
  throw std::runtime_error("there is no " + tracklets +
                           " nor label_02.txt: --boxes and --truth-objects need one of them, or "
                           "--labels FILE");
}

// The pose of a scan is that of its frame: the set's makers gave each frame the OXTS packet of its
// instant, whose own stamp tells when it arrived, up to 20 ms later.
std::vector<PoseSample> poses_of_scans(const Recording& recording) {
  std::map<int, std::size_t> pose_of_frame;
  const std::vector<Frame>& frames = recording.pose_frames.files.frames;
  for (std::size_t i = 0; i < frames.size(); ++i) pose_of_frame[frames[i].number] = i;
  std::vector<PoseSample> samples;
  for (const Frame& scan : recording.scans.files.frames) {
    const auto pose = pose_of_frame.find(scan.number);
    if (pose != pose_of_frame.end())
      samples.push_back({scan.stamp, recording.poses[pose->second].T_world_vehicle});
  }
  return samples;
}

std::vector<Stamp> stamps_of(const SensorFrames& sensor) {
  std::vector<Stamp> stamps;
  for (const Frame& frame : sensor.files.frames) stamps.push_back(frame.stamp);
  return stamps;
}

}  // namespace

Recording open_drive(const std::string& folder, const Selection& selection) {
  check_folder(folder);
  const FrameRange& range = selection.frames;
  // The day's calibration lies one folder up.
  const Calibration calibration = read_calibration(fs::canonical(folder).parent_path().string());
  Recording recording;
  recording.T_vehicle_lidar = calibration.T_vehicle_lidar;
  recording.T_vehicle_rectified_0 = calibration.T_vehicle_rectified_0;
  recording.pose_label = "OXTS";
  recording.scans = drive_frames(folder, "velodyne_points", {".bin"}, range);
  for (const int number : selection.cameras) {
    const std::string name = "image_0" + std::to_string(number);
    recording.cameras.push_back({camera_numbered(calibration, number),
                                 drive_frames(folder, name, {".png", ".jpg"}, range)});
  }
  if (!fs::is_directory(folder + "/oxts")) return recording;
  recording.pose_frames = drive_frames(folder, "oxts", {".txt"}, range);
  OxtsReader oxts;
  for (const Frame& frame : recording.pose_frames.files.frames) {
    recording.poses.push_back({frame.stamp, oxts.T_world_vehicle(frame.path)});
  }
  return recording;
}

Recording open_sequence(const std::string& folder, const Selection& selection) {
  check_folder(folder);
  const FrameRange& range = selection.frames;
  const Calibration calibration = read_sequence_calibration(folder + "/calib.txt");
  const FrameStamps stamps = read_times(folder + "/times.txt");
  Recording recording;
  recording.T_vehicle_lidar = calibration.T_vehicle_lidar;
  recording.T_vehicle_rectified_0 = calibration.T_vehicle_rectified_0;
  recording.pose_label = "POSES";
  recording.scans = {"velodyne", list_frames(folder + "/velodyne", stamps, {6, {".bin"}}, range)};
  for (const int number : selection.cameras) {
    const std::string name = "image_" + std::to_string(number);
    CameraFrames sensor{camera_numbered(calibration, number),
                        {name, list_frames((fs::path(folder) / name).string(), stamps,
                                           {6, {".png", ".jpg"}}, range)}};
    if (!sensor.pictures.files.frames.empty()) {
      const cv::Size size = importing::size_of_picture(sensor.pictures.files.frames.front().path);
      sensor.camera.model.width = size.width;
      sensor.camera.model.height = size.height;
    }
    recording.cameras.push_back(std::move(sensor));
  }
  const Pose& T_vehicle_camera_0 = camera_numbered(calibration, 0).T_vehicle_camera;
  read_sequence_poses(fs::canonical(folder), stamps, range, T_vehicle_camera_0, recording);
  return recording;
}

std::vector<std::string> add_tracks(Recording& recording, const std::string& drive,
                                    const std::string& labels) {
  const std::string path = labels.empty() ? label_file_of(drive) : labels;
  if (recording.poses.empty()) {
    throw std::runtime_error(drive +
                             " has no oxts: --boxes and --truth-objects need the vehicle's poses "
                             "to put labels over ground (is the drive's oxts folder unpacked?)");
  }
  Trajectory ego;
  for (const PoseSample& sample : poses_of_scans(recording)) ego.add(sample);
  if (fs::path(path).extension() == ".xml") {
    recording.tracks = tracks_in_world(read_tracklets(path), recording.scans.files.frames,
                                       recording.T_vehicle_lidar, ego);
    return {};
  }
  LabelledDrive labelled = labels_in_world({path, read_labels(path)}, recording, ego);
  recording.tracks = std::move(labelled.tracks);
  recording.ignored = std::move(labelled.ignored);
  return labelled.warnings;
}

std::vector<importing::LogItem> items_of(const Recording& recording) {
  std::vector<importing::LogItem> items;
  for (const Frame& frame : recording.scans.files.frames) {
    items.push_back({frame.stamp,
                     [&frame, &T = recording.T_vehicle_lidar] {
                       return observation_from_scan(read_scan(frame, T), Carrier::automatic);
                     },
                     frame.path});
  }
  for (const CameraFrames& sensor : recording.cameras) {
    for (const Frame& frame : sensor.pictures.files.frames) {
      items.push_back({frame.stamp,
                       [&frame, &camera = sensor.camera] {
                         return observation_from_image(
                             importing::read_picture(frame.path, frame.stamp, camera));
                       },
                       frame.path});
    }
  }
  for (const PoseSample& sample : recording.poses) {
    items.push_back({sample.stamp, [&sample, &label = recording.pose_label] {
                       return importing::pose_observation(sample, label);
                     }});
  }
  return items;
}

importing::LabelledLog labels_of(const Recording& recording) {
  importing::LabelledLog log;
  log.tracks = recording.tracks;
  log.ignored = recording.ignored;
  log.ego = poses_of_scans(recording);
  log.scans = stamps_of(recording.scans);
  for (const CameraFrames& sensor : recording.cameras) {
    log.cameras.push_back({sensor.camera, stamps_of(sensor.pictures)});
  }
  return log;
}

}  // namespace lidar_upsampling::kitti
