// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_label_tracks.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

namespace lidar_upsampling::kitti {
namespace {

using Frames = std::set<int>;

std::string from_to(const Frames& frames) {
  if (frames.empty()) return "none";
  return std::to_string(*frames.begin()) + " to " + std::to_string(*frames.rbegin());
}

// "3 of 8 labelled frames (5 to 7)"
std::string share_of(const Frames& part, std::size_t all, const std::string& what) {
  return std::to_string(part.size()) + " of " + std::to_string(all) + " " + what + " (" +
         from_to(part) + ")";
}

// The label of the camera that ignored areas go to.
std::optional<std::string> camera_of_areas(const Recording& recording) {
  for (const char* const label : {"CAM2", "CAM3", "CAM0", "CAM1"}) {
    for (const CameraFrames& camera : recording.cameras) {
      if (camera.camera.label == label) return label;
    }
  }
  return std::nullopt;
}

class DriveLabels {
 public:
  DriveLabels(const LabelFile& file, const Recording& recording, const Trajectory& ego)
      : path_(file.path), T_vehicle_rectified_0_(recording.T_vehicle_rectified_0), ego_(ego) {
    for (const Frame& scan : recording.scans.files.frames) stamps_[scan.number] = scan.stamp;
    camera_ = camera_of_areas(recording);
  }

  void add(const LabelRow& row) {
    labelled_.insert(row.frame);
    const auto scan = stamps_.find(row.frame);
    if (scan == stamps_.end()) {
      without_scan_.insert(row.frame);
    } else if (row.is_ignored_area()) {
      if (camera_) ignored_.push_back({scan->second, *camera_, row.box});
    } else {
      add_object(row, scan->second);
    }
  }

  [[nodiscard]] LabelledDrive result() const {
    if (without_scan_.size() == labelled_.size()) {
      throw std::runtime_error(path_ + ": no labelled frame (" + from_to(labelled_) +
                               ") is among the scans' (" + from_to(scan_frames()) +
                               "): labels of another drive, or counted from another frame?");
    }
    if (tracks_.empty() && !without_pose_.empty()) {
      throw std::runtime_error(path_ +
                               ": no labelled frame has a pose of the vehicle: oxts is of another "
                               "time than the scans");
    }
    LabelledDrive result;
    result.ignored = ignored_;
    for (auto [id, track] : tracks_) {
      std::sort(track.poses.begin(), track.poses.end(),
                [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
      result.tracks.push_back(std::move(track));
    }
    result.warnings = warnings();
    return result;
  }

 private:
  void add_object(const LabelRow& row, Stamp stamp) {
    const auto vehicle = ego_.at(stamp);
    if (!vehicle) {
      without_pose_.insert(row.frame);
      return;
    }
    importing::ObjectTrack& track = tracks_[row.track];
    track.id = row.track;
    track.class_name = importing::class_name_from(row.type);
    track.size = row.size;
    track.poses.push_back(
        {stamp, vehicle->T_world_vehicle * T_vehicle_rectified_0_ * row.T_rectified_0_object});
  }

  [[nodiscard]] Frames scan_frames() const {
    Frames frames;
    for (const auto& [number, stamp] : stamps_) frames.insert(number);
    return frames;
  }

  [[nodiscard]] std::vector<std::string> warnings() const {
    std::vector<std::string> lines;
    const auto note = [&](const Frames& frames, std::size_t all, const std::string& what,
                          const std::string& why) {
      if (!frames.empty()) lines.push_back(path_ + ": " + share_of(frames, all, what) + " " + why);
    };
    Frames unlabelled;
    for (const auto& [number, stamp] : stamps_) {
      if (labelled_.count(number) == 0) unlabelled.insert(number);
    }
    note(without_scan_, labelled_.size(), "labelled frames", "have no scan: left out");
    note(without_pose_, labelled_.size(), "labelled frames",
         "have no pose of the vehicle: left out (is oxts incomplete?)");
    note(unlabelled, stamps_.size(), "scans", "have no label, as if nothing was there");
    return lines;
  }

  std::string path_;
  Pose T_vehicle_rectified_0_;
  const Trajectory& ego_;
  std::map<int, Stamp> stamps_;
  std::optional<std::string> camera_;
  std::map<int, importing::ObjectTrack> tracks_;
  std::vector<importing::IgnoredArea> ignored_;
  Frames labelled_, without_scan_, without_pose_;
};

}  // namespace

LabelledDrive labels_in_world(const LabelFile& file, const Recording& recording,
                              const Trajectory& ego) {
  DriveLabels labels(file, recording, ego);
  for (const LabelRow& row : file.rows) labels.add(row);
  return labels.result();
}

}  // namespace lidar_upsampling::kitti
