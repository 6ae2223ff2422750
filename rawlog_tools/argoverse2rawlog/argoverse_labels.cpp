// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/argoverse_labels.h"

#include <map>
#include <stdexcept>

#include "import/json_file.h"

namespace lidar_upsampling::argoverse {
namespace {

using importing::ObjectTrack;

// Labels are at the box's centre, in the vehicle frame.
Pose T_vehicle_object(const nlohmann::json& label) {
  const auto number = [&](const char* group, const char* name) {
    return label.at(group).at(name).get<double>();
  };
  Pose T = Pose::Identity();
  T.linear() = importing::rotation_from(number("rotation", "w"), number("rotation", "x"),
                                        number("rotation", "y"), number("rotation", "z"));
  T.translation() =
      Eigen::Vector3d(number("center", "x"), number("center", "y"), number("center", "z"));
  return T;
}

ObjectTrack track_from(const nlohmann::json& label, int id) {
  ObjectTrack track;
  track.id = id;
  track.class_name = importing::class_name_from(label.at("label_class").get<std::string>());
  track.size = {label.at("length").get<double>(), label.at("width").get<double>(),
                label.at("height").get<double>()};
  return track;
}

}  // namespace

std::vector<ObjectTrack> read_tracks(const std::vector<StampedFile>& files, const Trajectory& ego) {
  std::vector<ObjectTrack> tracks;
  std::map<std::string, std::size_t> places;
  for (const StampedFile& file : files) {
    const auto vehicle = ego.at(file.stamp);
    if (!vehicle) continue;
    importing::with_json(file.path, [&](const nlohmann::json& labels) {
      for (const nlohmann::json& label : labels) {
        const auto uuid = label.at("track_label_uuid").get<std::string>();
        const auto [place, is_new] = places.emplace(uuid, tracks.size());
        if (is_new) tracks.push_back(track_from(label, static_cast<int>(tracks.size())));
        tracks[place->second].poses.push_back(
            {file.stamp, vehicle->T_world_vehicle * T_vehicle_object(label)});
      }
    });
  }
  return tracks;
}

}  // namespace lidar_upsampling::argoverse
