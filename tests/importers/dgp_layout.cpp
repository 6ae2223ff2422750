// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp_layout.h"

#include <cctype>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "lidar_upsampling/types.h"
#include "npz_layout.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

using nlohmann::json;

json json_of(const Pose& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d& t = T.translation();
  return {{"rotation", {{"qw", q.w()}, {"qx", q.x()}, {"qy", q.y()}, {"qz", q.z()}}},
          {"translation", {{"x", t.x()}, {"y", t.y()}, {"z", t.z()}}}};
}

// 100 ns since 1970, as DDAD's files are named.
std::string digits_of(Stamp stamp) {
  std::string text = to_text(stamp);
  text.erase(text.find('.'), 1);
  return text;
}

std::string sweep_name(int frame) {
  return "point_cloud/LIDAR/" + digits_of(frame_stamp(frame)) + ".npz";
}
std::string labels_name(int frame) {
  return "bounding_box_3d/LIDAR/" + digits_of(frame_stamp(frame)) + ".json";
}
std::string picture_name(int frame) {
  return "rgb/CAMERA_01/" + digits_of(dgp_picture_stamp(frame)) + ".png";
}

void write_json(const fs::path& file, const json& content) { std::ofstream(file) << content; }

const std::string& class_of(const SmallStreet& street, int id) {
  return street.world.objects[static_cast<std::size_t>(id)].class_name;
}

// The street's classes, each with some number.
std::map<std::string, int> class_ids(const SmallStreet& street) {
  std::map<std::string, int> ids;
  for (const int id : street.ids())
    ids.emplace(class_of(street, id), 2 + 3 * static_cast<int>(ids.size()));
  return ids;
}

void write_ontology(const fs::path& file, const SmallStreet& street) {
  json items = json::array();
  for (const auto& [own_name, id] : class_ids(street)) {
    std::string name = own_name;
    name[0] = static_cast<char>(std::toupper(name[0]));
    items.push_back({{"id", id}, {"name", name}});
  }
  write_json(file, {{"items", items}});
}

json labels_at(const SmallStreet& street, Stamp stamp) {
  const Pose T_world_lidar = street.T_world_vehicle(stamp) * street.lidar.T_vehicle_lidar;
  const std::map<std::string, int> classes = class_ids(street);
  json annotations = json::array();
  for (const int id : street.ids()) {
    const Eigen::Vector3d size = street.size_of(id);
    const Pose T = T_world_lidar.inverse() * street.T_world_object(id, stamp);
    annotations.push_back({{"class_id", classes.at(class_of(street, id))},
                           {"instance_id", 3000000000LL + id},  // more than an int holds
                           {"box",
                            {{"length", size.x()},
                             {"width", size.y()},
                             {"height", size.z()},
                             {"pose", json_of(T)}}}});
  }
  return {{"annotations", annotations}};
}

json datum(const std::string& key, const std::string& sensor, const std::string& kind,
           const json& content) {
  // The time is DDAD's: ten times what it should be.
  return {{"key", key},
          {"id", {{"name", sensor}, {"timestamp", "2463-05-15T00:38:58.203752Z"}}},
          {"datum", {{kind, content}}}};
}

void write_calibration(const fs::path& folder, const SmallStreet& street) {
  const Camera& camera = street.camera.camera;
  const json none = {{"fx", 0}, {"fy", 0}, {"cx", 0}, {"cy", 0}, {"skew", 0}};
  const json intrinsics = {{"fx", camera.model.fx},
                           {"fy", camera.model.fy},
                           {"cx", camera.model.cx},
                           {"cy", camera.model.cy},
                           {"skew", 0}};
  write_json(
      folder / "calibration/c0.json",
      {{"names", {"LIDAR", "CAMERA_01"}},
       {"extrinsics", {json_of(street.lidar.T_vehicle_lidar), json_of(camera.T_vehicle_camera)}},
       {"intrinsics", {none, intrinsics}}});
}

}  // namespace

Stamp dgp_picture_stamp(int frame) { return shifted(frame_stamp(frame), 0.01); }

fs::path DgpScene::sweep(int frame) const { return folder / sweep_name(frame); }
fs::path DgpScene::labels(int frame) const { return folder / labels_name(frame); }
void DgpScene::write_scene() const { write_json(scene_file, scene); }

DgpScene::DgpScene(const fs::path& in) : folder(in), scene_file(in / "scene_0a.json") {
  street.camera.camera.label = "CAMERA_01";
  for (const char* const name :
       {"calibration", "ontology", "point_cloud/LIDAR", "rgb/CAMERA_01", "bounding_box_3d/LIDAR"}) {
    fs::create_directories(folder / name);
  }
  write_calibration(folder, street);
  write_ontology(folder / "ontology/o1.json", street);
  scene = {{"data", json::array()}, {"samples", json::array()}, {"ontologies", {{"1", "o1"}}}};
  for (int i = 0; i < kNumFrames; ++i) {
    const Stamp stamp = frame_stamp(i), picture = dgp_picture_stamp(i);
    write_npz(sweep(i), street.scan(stamp), i % 2 == 0);
    write_json(labels(i), labels_at(street, stamp));
    cv::imwrite((folder / picture_name(i)).string(), street.picture(picture).image.bgr);
    const std::string cloud_key = "l" + std::to_string(i), image_key = "c" + std::to_string(i);
    const Pose T_world_lidar = street.T_world_vehicle(stamp) * street.lidar.T_vehicle_lidar;
    const Pose T_world_camera =
        street.T_world_vehicle(picture) * street.camera.camera.T_vehicle_camera;
    scene["data"].push_back(datum(cloud_key, "LIDAR", "point_cloud",
                                  {{"filename", sweep_name(i)},
                                   {"annotations", {{"1", labels_name(i)}}},
                                   {"pose", json_of(T_world_lidar)}}));
    scene["data"].push_back(
        datum(image_key, "CAMERA_01", "image",
              {{"filename", picture_name(i)}, {"pose", json_of(T_world_camera)}}));
    scene["samples"].push_back({{"calibration_key", "c0"}, {"datum_keys", {cloud_key, image_key}}});
  }
  write_scene();
}

}  // namespace lidar_upsampling
