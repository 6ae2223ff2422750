// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/label_files.h"

#include <filesystem>
#include <iomanip>
#include <set>
#include <stdexcept>

#include "import/box_projection.h"
#include "import/track_jumps.h"

namespace lidar_upsampling::importing {
namespace {

// Of another table beside the objects'.
std::string beside(const std::string& objects_path, const std::string& new_ending) {
  const std::string ending = "_objects.csv";
  const auto at = objects_path.rfind(ending);
  if (at == std::string::npos || at + ending.size() != objects_path.size()) {
    throw std::runtime_error("--truth-objects " + objects_path + ": the name must end in " +
                             ending + ", as the ego-motion goes to ..._ego.csv beside it");
  }
  return objects_path.substr(0, at) + new_ending;
}

std::vector<PoseSample> ego_at_all_stamps(const LabelledLog& log, const Trajectory& ego) {
  std::set<Stamp> stamps(log.scans.begin(), log.scans.end());
  for (const CameraStamps& camera : log.cameras) {
    stamps.insert(camera.stamps.begin(), camera.stamps.end());
  }
  for (const PoseSample& sample : log.ego) stamps.insert(sample.stamp);
  std::vector<PoseSample> samples;
  for (const Stamp stamp : stamps) {
    if (const auto pose = ego.at(stamp)) samples.push_back({stamp, pose->T_world_vehicle});
  }
  return samples;
}

std::optional<Box2d> box_on_picture(const Camera& camera, Stamp stamp, const Trajectory& ego,
                                    const ObjectTrack& track, const TrackInterpolator& positions) {
  const auto vehicle = ego.at(stamp);
  const auto T_world_object = positions.T_world_object(stamp);
  if (!vehicle || !T_world_object) return std::nullopt;
  const Pose T_world_camera = vehicle->T_world_vehicle * camera.T_vehicle_camera;
  return project_box(camera.model, T_world_camera.inverse() * *T_world_object, track.size);
}

}  // namespace

LabelFiles::LabelFiles(const LabelPaths& paths) {
  if (!paths.boxes.empty()) boxes_.emplace(paths.boxes, OutputOptions{paths.overwrite});
  if (paths.truth_objects.empty()) return;
  ego_.emplace(beside(paths.truth_objects, "_ego.csv"), OutputOptions{paths.overwrite});
  ignored_path_ = beside(paths.truth_objects, "_ignored.csv");
  ignored_.emplace(ignored_path_, OutputOptions{paths.overwrite});
  objects_.emplace(paths.truth_objects, OutputOptions{paths.overwrite});
}

void LabelFiles::write(const LabelledLog& log) {
  const SteadyTracks steady = without_jumps(log.tracks);
  if (const std::string warning = warning_of(steady); !warning.empty()) {
    warnings_.push_back(warning);
  }
  num_objects_ = steady.tracks.size();
  Trajectory ego;
  for (const PoseSample& sample : log.ego) ego.add(sample);
  if (boxes_) write_boxes(log, steady.tracks, ego);
  if (!objects_) return;
  write_objects_table(objects_->stream(), steady.tracks);
  write_ego_table(ego_->stream(), ego_at_all_stamps(log, ego));
  if (log.ignored.empty()) {
    ignored_.reset();
  } else {
    write_ignored_table(ignored_->stream(), log.ignored);
  }
}

void LabelFiles::write_boxes(const LabelledLog& log, const std::vector<ObjectTrack>& tracks,
                             const Trajectory& ego) {
  std::ostream& out = boxes_->stream();
  out << "label,stamp,class,score,left,top,right,bottom,track\n"
      << std::fixed << std::setprecision(2);
  for (const ObjectTrack& track : tracks) {
    const TrackInterpolator positions(track);
    for (const auto& [camera, stamps] : log.cameras) {
      for (const Stamp stamp : stamps) {
        const auto box = box_on_picture(camera, stamp, ego, track, positions);
        if (!box) continue;
        out << camera.label << ',' << stamp.time_since_epoch().count() << ',' << track.class_name
            << ",1," << box->left << ',' << box->top << ',' << box->right << ',' << box->bottom
            << ',' << track.id << '\n';
        ++num_boxes_;
      }
    }
  }
}

void LabelFiles::commit() {
  // One that a former import left does not belong to these labels.
  if (objects_ && !ignored_) std::filesystem::remove(ignored_path_);
  for (auto* file : {&boxes_, &objects_, &ego_, &ignored_}) {
    if (*file) (*file)->commit();
  }
}

}  // namespace lidar_upsampling::importing
