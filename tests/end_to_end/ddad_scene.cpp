// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "end_to_end/ddad_scene.h"

#include <zlib.h>

#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

using Json = nlohmann::json;

Json read_json(const fs::path& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

Pose pose_of(const Json& json) {
  const Json& q = json.at("rotation");
  const Json& t = json.at("translation");
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(q.at("qw"), q.at("qx"), q.at("qy"), q.at("qz"))
                      .normalized()
                      .toRotationMatrix();
  pose.translation() << t.at("x"), t.at("y"), t.at("z");
  return pose;
}

// Files are named by their time, in 100 ns since 1970.
Stamp stamp_of(const fs::path& file) {
  return mrpt::Clock::fromDouble(0) + mrpt::Clock::duration(std::stoll(file.stem().string()));
}

template <typename Number>
Number little_endian(const std::vector<char>& bytes, std::size_t at) {
  Number number = 0;
  if (at + sizeof number > bytes.size()) throw std::runtime_error("the archive is cut off");
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

// The first file of a zip archive whose local header tells the sizes.
std::vector<char> first_of_zip(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> zip{std::istreambuf_iterator<char>(file), {}};
  if (little_endian<std::uint32_t>(zip, 0) != 0x04034b50)
    throw std::runtime_error(path.string() + ": no zip archive");
  const auto method = little_endian<std::uint16_t>(zip, 8);
  const auto packed_size = little_endian<std::uint32_t>(zip, 18);
  const std::size_t begin =
      30U + little_endian<std::uint16_t>(zip, 26) + little_endian<std::uint16_t>(zip, 28);
  std::vector<char> out(little_endian<std::uint32_t>(zip, 22));
  if (begin + packed_size > zip.size()) throw std::runtime_error(path.string() + ": cut off");
  if (method == 0) {
    std::copy_n(zip.begin() + static_cast<std::ptrdiff_t>(begin), out.size(), out.begin());
    return out;
  }
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zip.data() + begin));
  stream.avail_in = packed_size;
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  inflateInit2(&stream, -MAX_WBITS);
  const int status = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error(path.string() + ": cannot be unpacked");
  return out;
}

LidarScan read_scan(const fs::path& path) {
  const std::vector<char> npy = first_of_zip(path);
  const std::size_t begin = 10U + little_endian<std::uint16_t>(npy, 8);
  const std::string header(npy.begin() + 10, npy.begin() + static_cast<std::ptrdiff_t>(begin));
  if (header.find("'<f8'") == std::string::npos || header.find(", 4)") == std::string::npos)
    throw std::runtime_error(path.string() + ": expected N x 4 doubles, found " + header);
  LidarScan scan;
  scan.label = "LIDAR";
  scan.stamp = stamp_of(path);
  for (std::size_t at = begin; at + 32 <= npy.size(); at += 32) {
    double row[4];
    std::memcpy(row, npy.data() + at, sizeof row);
    scan.points.emplace_back(Eigen::Vector3d(row[0], row[1], row[2]).cast<float>());
    scan.intensity.push_back(static_cast<float>(row[3]));
  }
  const float strongest = *std::max_element(scan.intensity.begin(), scan.intensity.end());
  if (strongest > 1)
    for (float& intensity : scan.intensity) intensity /= strongest;
  return scan;
}

struct Calibration {
  std::map<std::string, Pose> T_vehicle_sensor;
  std::map<std::string, CameraModel> model;
};

Calibration read_calibration(const fs::path& path) {
  const Json json = read_json(path);
  Calibration calibration;
  for (std::size_t i = 0; i < json.at("names").size(); ++i) {
    const std::string name = json["names"][i];
    calibration.T_vehicle_sensor[name] = pose_of(json.at("extrinsics").at(i));
    const Json& intrinsics = json.at("intrinsics").at(i);
    CameraModel& model = calibration.model[name];
    model.fx = intrinsics.at("fx");
    model.fy = intrinsics.at("fy");
    model.cx = intrinsics.at("cx");
    model.cy = intrinsics.at("cy");
  }
  return calibration;
}

CameraImage read_image(const fs::path& path, const std::string& label,
                       const Calibration& calibration) {
  CameraImage image;
  image.stamp = stamp_of(path);
  image.bgr = cv::imread(path.string());
  if (image.bgr.empty()) throw std::runtime_error(path.string() + ": no picture");
  image.camera.label = label;
  image.camera.model = calibration.model.at(label);
  image.camera.model.width = image.bgr.cols;
  image.camera.model.height = image.bgr.rows;
  image.camera.T_vehicle_camera = calibration.T_vehicle_sensor.at(label);
  return image;
}

fs::path scene_file(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().rfind("scene_", 0) == 0) return entry.path();
  throw std::runtime_error(folder.string() + ": no scene_*.json");
}

}  // namespace

std::vector<DgpSample> load_dgp_scene(const fs::path& folder) {
  const Json scene = read_json(scene_file(folder));
  std::map<std::string, const Json*> data;
  for (const Json& datum : scene.at("data")) data[datum.at("key")] = &datum;

  std::vector<DgpSample> samples;
  for (const Json& sample_json : scene.at("samples")) {
    const auto calibration = read_calibration(
        folder / "calibration" / (sample_json.at("calibration_key").get<std::string>() + ".json"));
    DgpSample sample;
    for (const Json& key : sample_json.at("datum_keys")) {
      const Json& datum = *data.at(key);
      const std::string name = datum.at("id").at("name");
      if (datum.at("datum").contains("image")) {
        const std::string file = datum["datum"]["image"].at("filename");
        sample.images.push_back(read_image(folder / file, name, calibration));
        continue;
      }
      const Json& cloud = datum.at("datum").at("point_cloud");
      sample.scan = read_scan(folder / cloud.at("filename").get<std::string>());
      sample.scan.T_vehicle_lidar = calibration.T_vehicle_sensor.at(name);
      sample.T_world_vehicle = pose_of(cloud.at("pose")) * sample.scan.T_vehicle_lidar.inverse();
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace lidar_upsampling
