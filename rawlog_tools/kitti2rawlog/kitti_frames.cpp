// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_frames.h"

#include <stdexcept>

#include "import/input_file.h"
#include "kitti2rawlog/hdl64_rings.h"

namespace lidar_upsampling::kitti {
namespace {

std::vector<float> read_floats(const std::string& path) {
  std::ifstream in = importing::open_file(path, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error("cannot read the scan " + path);
  const auto num_bytes = static_cast<std::size_t>(in.tellg());
  if (num_bytes % (4 * sizeof(float)) != 0) {
    throw std::runtime_error(path + ": " + std::to_string(num_bytes) +
                             " bytes are no whole number of points (x, y, z, reflectance)");
  }
  std::vector<float> values(num_bytes / sizeof(float));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(num_bytes));
  if (!in) throw std::runtime_error("cannot read the scan " + path);
  return values;
}

}  // namespace

LidarScan read_scan(const Frame& frame, const Pose& T_vehicle_lidar) {
  LidarScan scan;
  scan.stamp = frame.stamp;
  scan.label = "LIDAR";
  scan.T_vehicle_lidar = T_vehicle_lidar;
  const std::vector<float> values = read_floats(frame.path);
  for (std::size_t i = 0; i < values.size(); i += 4) {
    const Eigen::Vector3f point(values[i], values[i + 1], values[i + 2]);
    if (!point.allFinite() || point.isZero(0.F)) continue;
    scan.points.push_back(point);
    scan.intensity.push_back(values[i + 3]);
  }
  derive_rings(scan);
  return scan;
}

Pose OxtsReader::T_world_vehicle(const std::string& path) {
  std::ifstream in = importing::open_file(path);
  double latitude = 0, longitude = 0, height = 0, roll = 0, pitch = 0, yaw = 0;
  if (!(in >> latitude >> longitude >> height >> roll >> pitch >> yaw)) {
    throw std::runtime_error(path +
                             " does not start with latitude, longitude, altitude, roll, pitch "
                             "and yaw");
  }
  if (!world_) world_.emplace(latitude, longitude, height);
  Pose T = Pose::Identity();
  world_->Forward(latitude, longitude, height, T.translation().x(), T.translation().y(),
                  T.translation().z());
  // Yaw counts from East, counter-clockwise; pitch is positive with the front down.
  T.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return T;
}

}  // namespace lidar_upsampling::kitti
