// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp_layout.h"

#include <zlib.h>

#include <cctype>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "lidar_upsampling/types.h"

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

template <typename Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(bytes.size() + 1000, '\0');
  std::string in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string npy_of(const LidarScan& scan) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(scan.size()) + ", 4), }";
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string npy("\x93NUMPY\x01\0", 8);
  append(npy, static_cast<std::uint16_t>(header.size()));
  npy += header;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    for (int k = 0; k < 3; ++k) append(npy, static_cast<double>(scan.points[i][k]));
    append(npy, static_cast<double>(scan.intensity[i]));
  }
  return npy;
}

// The fields that both the header before a file and its entry in the directory have; numpy leaves
// the sizes to an extra field in the former.
std::string common_fields(bool packed, std::uint32_t packed_size, std::uint32_t size,
                          std::uint16_t extra) {
  std::string fields;
  for (const int value : {20, 0, packed ? 8 : 0, 0, 0}) {
    append(fields, static_cast<std::uint16_t>(value));
  }
  append(fields, std::uint32_t{0});  // checksum
  append(fields, packed_size);
  append(fields, size);
  append(fields, std::uint16_t{8});
  append(fields, extra);
  return fields;
}

}  // namespace

void write_npz(const fs::path& file, const LidarScan& scan, bool packed) {
  const std::string npy = npy_of(scan), content = packed ? deflated(npy) : npy;
  const auto size = static_cast<std::uint32_t>(npy.size());
  const auto packed_size = static_cast<std::uint32_t>(content.size());
  std::string zip = "PK\x03\x04" + common_fields(packed, ~0U, ~0U, 20) + "data.npy";
  append(zip, std::uint32_t{0x00100001});
  append(zip, std::uint64_t{size});
  append(zip, std::uint64_t{packed_size});
  zip += content;
  const auto directory = static_cast<std::uint32_t>(zip.size());
  zip += "PK\x01\x02";
  append(zip, std::uint16_t{20});
  zip += common_fields(packed, packed_size, size, 0) + std::string(14, '\0') + "data.npy";
  const auto end = static_cast<std::uint32_t>(zip.size());
  zip += std::string("PK\x05\x06\0\0\0\0\x01\0\x01\0", 12);
  append(zip, end - directory);
  append(zip, directory);
  append(zip, std::uint16_t{0});
  std::ofstream(file, std::ios::binary) << zip;
}

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
