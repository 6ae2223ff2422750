// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp2rawlog/dgp_labels.h"

#include <map>
#include <stdexcept>

#include "dgp2rawlog/dgp_calibration.h"
#include "import/json_file.h"

namespace lidar_upsampling::dgp {
namespace {

using importing::ObjectTrack;
using nlohmann::json;

std::map<int, std::string> read_classes(const std::string& path) {
  std::map<int, std::string> classes;
  importing::with_json(path, [&](const json& ontology) {
    for (const json& item : ontology.at("items")) {
      classes[item.at("id").get<int>()] =
          importing::class_name_from(item.at("name").get<std::string>());
    }
  });
  return classes;
}

class LabelReader {
 public:
  explicit LabelReader(std::map<int, std::string> classes) : classes_(std::move(classes)) {}

  void add(const json& label, const SensorFile& sweep) {
    const auto id = label.at("instance_id").get<std::int64_t>();
    const auto [place, is_new] = places_.emplace(id, tracks_.size());
    if (is_new) tracks_.push_back(track_from(label));
    ObjectTrack& track = tracks_[place->second];
    if (!track.poses.empty() && track.poses.back().stamp == sweep.stamp) {
      throw std::invalid_argument("instance " + std::to_string(id) + " is labelled twice");
    }
    const Pose T_lidar_object = pose_from(label.at("box").at("pose"));
    track.poses.push_back(
        {sweep.stamp, sweep.T_world_vehicle * sweep.T_vehicle_sensor * T_lidar_object});
  }

  [[nodiscard]] const std::vector<ObjectTrack>& tracks() const { return tracks_; }

 private:
  [[nodiscard]] ObjectTrack track_from(const json& label) const {
    const json& box = label.at("box");
    ObjectTrack track;
    track.id = static_cast<int>(tracks_.size());
    track.size = {box.at("length").get<double>(), box.at("width").get<double>(),
                  box.at("height").get<double>()};
    if (!(track.size.minCoeff() > 0)) {
      throw std::invalid_argument("instance " + label.at("instance_id").dump() +
                                  " is a box without extent");
    }
    const int class_id = label.at("class_id").get<int>();
    const auto name = classes_.find(class_id);
    if (name == classes_.end()) {
      throw std::invalid_argument("class_id " + std::to_string(class_id) +
                                  " is not in the scene's ontology");
    }
    track.class_name = name->second;
    return track;
  }

  std::map<int, std::string> classes_;
  std::map<std::int64_t, std::size_t> places_;
  std::vector<ObjectTrack> tracks_;
};

}  // namespace

SceneLabels read_labels(const Scene& scene) {
  std::size_t num_labelled = 0;
  for (const Sweep& sweep : scene.sweeps) num_labelled += sweep.labels.empty() ? 0 : 1;
  if (num_labelled == 0 || scene.ontology.empty()) {
    throw std::runtime_error(scene.path + ": its point clouds have no 3D boxes (annotation 1): " +
                             "--boxes and --truth-objects need them (scenes of the test split "
                             "have none)");
  }
  LabelReader reader(read_classes(scene.ontology));
  for (const Sweep& sweep : scene.sweeps) {
    if (sweep.labels.empty()) continue;
    importing::with_json(sweep.labels, [&](const json& content) {
      for (const json& label : content.at("annotations")) reader.add(label, sweep.file);
    });
  }
  SceneLabels labels{reader.tracks(), {}};
  const std::size_t num_without = scene.sweeps.size() - num_labelled;
  if (num_without > 0) {
    labels.warnings.push_back(scene.path + ": " + std::to_string(num_without) + " of " +
                              std::to_string(scene.sweeps.size()) +
                              " scans have no labels, as if nothing was there");
  }
  return labels;
}

}  // namespace lidar_upsampling::dgp
