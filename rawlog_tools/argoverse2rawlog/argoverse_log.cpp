// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/argoverse_log.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "argoverse2rawlog/argoverse_labels.h"
#include "argoverse2rawlog/argoverse_sweep.h"
#include "import/json_file.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"

namespace fs = std::filesystem;

namespace lidar_upsampling::argoverse {
namespace {

// MRPT's ticks of 100 ns count from 1601.
constexpr std::int64_t kUnixEpochTicks = 116'444'736'000'000'000;

std::optional<Stamp> stamp_of(const std::string& text) {
  std::int64_t nanoseconds = -1;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, nanoseconds);
  if (error != std::errc() || rest != end || nanoseconds < 0) return std::nullopt;
  const std::int64_t ticks = nanoseconds / 100 + (nanoseconds % 100 >= 50 ? 1 : 0);
  return Stamp(mrpt::Clock::duration(kUnixEpochTicks + ticks));
}

CameraFiles open_camera(const std::string& folder, const std::string& name,
                        const Calibration& calibration) {
  const auto camera = calibration.cameras.find(name);
  if (camera == calibration.cameras.end()) {
    throw std::runtime_error("no calibration of camera " + name);
  }
  CameraFiles files{camera->second, stamped_files(folder + "/" + name, name + "_", ".jpg")};
  if (files.pictures.empty()) {
    throw std::runtime_error("no picture " + folder + "/" + name + "/" + name +
                             "_<nanoseconds>.jpg is there");
  }
  const cv::Size size = importing::size_of_picture(files.pictures.front().path);
  files.camera.model.width = size.width;
  files.camera.model.height = size.height;
  return files;
}

std::vector<PoseSample> read_poses(const std::string& folder) {
  std::vector<PoseSample> poses;
  for (const StampedFile& file : stamped_files(folder, "city_SE3_egovehicle_", ".json")) {
    importing::with_json(file.path, [&](const nlohmann::json& json) {
      poses.push_back({file.stamp, importing::pose_from_json(json)});
    });
  }
  return poses;
}

std::vector<Stamp> stamps_of(const std::vector<StampedFile>& files) {
  std::vector<Stamp> stamps(files.size());
  std::transform(files.begin(), files.end(), stamps.begin(),
                 [](const StampedFile& file) { return file.stamp; });
  return stamps;
}

}  // namespace

std::vector<StampedFile> stamped_files(const std::string& folder, const std::string& prefix,
                                       const std::string& extension) {
  std::vector<StampedFile> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    if (stem.rfind(prefix, 0) != 0 || entry.path().extension() != extension) continue;
    if (const auto stamp = stamp_of(stem.substr(prefix.size()))) {
      files.push_back({*stamp, entry.path().string()});
    }
  }
  std::sort(files.begin(), files.end(),
            [](const StampedFile& a, const StampedFile& b) { return a.stamp < b.stamp; });
  return files;
}

TrackingLog open_log(const std::string& folder, const std::vector<std::string>& cameras) {
  if (!fs::is_directory(folder)) throw std::runtime_error("there is no folder " + folder);
  TrackingLog log;
  log.calibration = read_calibration(folder + "/vehicle_calibration_info.json");
  log.sweeps = stamped_files(folder + "/lidar", "PC_", ".ply");
  if (log.sweeps.empty()) {
    throw std::runtime_error("no sweep " + folder + "/lidar/PC_<nanoseconds>.ply is there");
  }
  for (const std::string& name : cameras) {
    log.cameras.push_back(open_camera(folder, name, log.calibration));
  }
  log.poses = read_poses(folder + "/poses");
  return log;
}

void add_tracks(TrackingLog& log, const std::string& folder) {
  const auto files =
      stamped_files(folder + "/per_sweep_annotations_amodal", "tracked_object_labels_", ".json");
  if (files.empty()) {
    throw std::runtime_error(folder +
                             " has no per_sweep_annotations_amodal: --boxes and --truth-objects "
                             "need them (logs of the test split have none)");
  }
  if (log.poses.empty()) {
    throw std::runtime_error(folder +
                             " has no poses: --boxes and --truth-objects need the vehicle's poses");
  }
  Trajectory ego;
  for (const PoseSample& sample : log.poses) ego.add(sample);
  log.tracks = read_tracks(files, ego);
}

std::vector<importing::LogItem> items_of(const TrackingLog& log) {
  std::vector<importing::LogItem> items;
  for (const PoseSample& sample : log.poses) {
    items.push_back(
        {sample.stamp, [&sample] { return importing::pose_observation(sample, "POSES"); }});
  }
  for (const StampedFile& file : log.sweeps) {
    items.push_back({file.stamp,
                     [&file, &calibration = log.calibration] {
                       return observation_from_scan(read_sweep(file.path, file.stamp, calibration),
                                                    Carrier::automatic);
                     },
                     file.path});
  }
  for (const CameraFiles& files : log.cameras) {
    for (const StampedFile& file : files.pictures) {
      items.push_back({file.stamp,
                       [&file, &camera = files.camera] {
                         return observation_from_image(
                             importing::read_picture(file.path, file.stamp, camera));
                       },
                       file.path});
    }
  }
  return items;
}

importing::LabelledLog labels_of(const TrackingLog& log) {
  importing::LabelledLog labelled;
  labelled.tracks = log.tracks;
  labelled.ego = log.poses;
  labelled.scans = stamps_of(log.sweeps);
  for (const CameraFiles& files : log.cameras) {
    labelled.cameras.push_back({files.camera, stamps_of(files.pictures)});
  }
  return labelled;
}

}  // namespace lidar_upsampling::argoverse
