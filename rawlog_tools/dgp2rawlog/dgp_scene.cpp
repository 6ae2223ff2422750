// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp2rawlog/dgp_scene.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "dgp2rawlog/dgp_calibration.h"
#include "import/json_file.h"
#include "import/log_items.h"
#include "lidar_upsampling/types.h"

namespace fs = std::filesystem;

namespace lidar_upsampling::dgp {
namespace {

using nlohmann::json;

constexpr const char* kBoxes3d = "1";  // the layout's number for this kind of annotation

fs::path scene_file(const fs::path& path) {
  if (!fs::is_directory(path)) {
    if (fs::is_regular_file(path)) return path;
    throw std::runtime_error("there is no folder " + path.string());
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    const bool is_scene = entry.path().filename().string().rfind("scene_", 0) == 0;
    if (is_scene && entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (files.size() == 1) return files.front();
  throw std::runtime_error(
      path.string() + " holds " + std::to_string(files.size()) + " files scene_*.json: " +
      (files.empty() ? "is it the folder of one scene?" : "--scene can name one of them"));
}

// Reads the scene's file; the calibration files once each.
class SceneReader {
 public:
  SceneReader(const json& scene, fs::path folder, const std::vector<std::string>& cameras)
      : scene_(scene), folder_(std::move(folder)), cameras_(cameras) {
    for (const json& datum : scene.at("data")) {
      data_[datum.at("key").get_ref<const std::string&>()] = &datum;
    }
  }

  void read(Scene& result) {
    for (const json& sample : scene_.at("samples")) {
      const Calibration& sensors = calibration(sample.at("calibration_key").get<std::string>());
      for (const json& key : sample.at("datum_keys")) {
        const auto datum = data_.find(key.get_ref<const std::string&>());
        if (datum == data_.end()) {
          throw std::invalid_argument("no data of key " + key.get<std::string>());
        }
        add(*datum->second, sensors, result);
      }
    }
    check_cameras();
    const json ontologies = scene_.value("ontologies", json::object());
    if (!ontologies.contains(kBoxes3d)) return;
    result.ontology =
        (folder_ / "ontology" / (ontologies.at(kBoxes3d).get<std::string>() + ".json")).string();
  }

 private:
  const Calibration& calibration(const std::string& key) {
    const auto [place, is_new] = calibrations_.try_emplace(key);
    if (is_new) {
      place->second = read_calibration((folder_ / "calibration" / (key + ".json")).string());
    }
    return place->second;
  }

  void add(const json& datum, const Calibration& sensors, Scene& result) {
    const auto name = datum.at("id").at("name").get<std::string>();
    const json& content = datum.at("datum");
    if (content.contains("point_cloud")) {
      const json& cloud = content["point_cloud"];
      Sweep sweep{file_of(datum, cloud, sensors), {}};
      const json labels = cloud.value("annotations", json::object());
      if (labels.contains(kBoxes3d)) {
        sweep.labels = (folder_ / labels[kBoxes3d].get<std::string>()).string();
      }
      result.sweeps.push_back(std::move(sweep));
    } else if (content.contains("image")) {
      found_.insert(name);
      if (!cameras_.empty() &&
          std::find(cameras_.begin(), cameras_.end(), name) == cameras_.end()) {
        return;
      }
      SensorFile file = file_of(datum, content["image"], sensors);
      Camera camera{name, sensors.at(name).model, file.T_vehicle_sensor};
      result.pictures.push_back({std::move(file), std::move(camera)});
    }
  }

  [[nodiscard]] SensorFile file_of(const json& datum, const json& content,
                                   const Calibration& sensors) const {
    SensorFile file;
    file.sensor = datum.at("id").at("name").get<std::string>();
    const auto sensor = sensors.find(file.sensor);
    if (sensor == sensors.end()) {
      throw std::invalid_argument("no calibration of " + file.sensor);
    }
    file.path = (folder_ / content.at("filename").get<std::string>()).string();
    const auto time = datum.at("id").value("timestamp", std::string());
    const auto stamp = stamp_of(file.path, time);
    if (!stamp) {
      throw std::invalid_argument("neither the name of " + file.path + " nor '" + time +
                                  "' is a time");
    }
    file.stamp = *stamp;
    file.T_vehicle_sensor = sensor->second.T_vehicle_sensor;
    file.T_world_vehicle = pose_from(content.at("pose")) * file.T_vehicle_sensor.inverse();
    return file;
  }

  void check_cameras() const {
    for (const std::string& name : cameras_) {
      if (found_.count(name) > 0) continue;
      std::string known;
      for (const std::string& other : found_) known.append(known.empty() ? "" : ", ").append(other);
      throw std::invalid_argument("no camera " + name + "; there are: " + known);
    }
  }

  const json& scene_;
  fs::path folder_;
  const std::vector<std::string>& cameras_;
  std::map<std::string, const json*> data_;
  std::map<std::string, Calibration> calibrations_;
  std::set<std::string> found_;
};

template <typename File>
void sort_by_stamp(std::vector<File>& files) {
  std::stable_sort(files.begin(), files.end(),
                   [](const File& a, const File& b) { return a.file.stamp < b.file.stamp; });
}

// The calibration knows no sizes; one camera's pictures are all alike, or reading them says so.
void measure_pictures(std::vector<Picture>& pictures) {
  std::map<std::string, cv::Size> sizes;
  for (Picture& picture : pictures) {
    const auto [place, is_new] = sizes.try_emplace(picture.camera.label);
    if (is_new) place->second = importing::size_of_picture(picture.file.path);
    picture.camera.model.width = place->second.width;
    picture.camera.model.height = place->second.height;
  }
}

}  // namespace

std::optional<Stamp> stamp_of(const std::string& path, const std::string& iso_time) {
  const std::string name = fs::path(path).stem().string();
  const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
  if (is_number && name.size() >= 16 && name.size() <= 19 && name.front() != '0') {
    return parse_stamp(name.substr(0, 10) + "." + name.substr(10));
  }
  std::tm time{};
  int end = 0;
  if (std::sscanf(iso_time.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d%n", &time.tm_year, &time.tm_mon,
                  &time.tm_mday, &time.tm_hour, &time.tm_min, &time.tm_sec, &end) != 6) {
    return std::nullopt;
  }
  time.tm_year -= 1900;
  time.tm_mon -= 1;
  std::string fraction = iso_time.substr(static_cast<std::size_t>(end));
  if (!fraction.empty() && fraction.back() == 'Z') fraction.pop_back();
  if (!fraction.empty() && fraction.front() != '.') return std::nullopt;
  if (fraction.find_first_not_of("0123456789", 1) != std::string::npos) return std::nullopt;
  return parse_stamp(std::to_string(timegm(&time)) + (fraction.size() > 1 ? fraction : ".0"));
}

Scene open_scene(const std::string& path, const std::vector<std::string>& cameras) {
  const fs::path file = scene_file(path);
  Scene scene;
  scene.path = file.string();
  importing::with_json(scene.path, [&](const json& content) {
    SceneReader(content, file.parent_path(), cameras).read(scene);
  });
  if (scene.sweeps.empty()) throw std::runtime_error(scene.path + " names no point cloud");
  sort_by_stamp(scene.sweeps);
  sort_by_stamp(scene.pictures);
  measure_pictures(scene.pictures);
  return scene;
}

}  // namespace lidar_upsampling::dgp
