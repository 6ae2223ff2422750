// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp2rawlog/dgp_log.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "dgp2rawlog/npz_file.h"
#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling::dgp {
namespace {

constexpr double kBrightest = 255;  // where intensities are no share

}  // namespace

LidarScan read_sweep(const Sweep& sweep) {
  const Rows rows = read_npz(sweep.file.path);
  if (rows.cols() < 4) {
    throw std::runtime_error(sweep.file.path + ": " + std::to_string(rows.cols()) +
                             " columns instead of x, y, z, intensity");
  }
  LidarScan scan;
  scan.stamp = sweep.file.stamp;
  scan.label = sweep.file.sensor;
  scan.T_vehicle_lidar = sweep.file.T_vehicle_sensor;
  const bool is_share = rows.rows() == 0 || rows.col(3).maxCoeff() <= 1;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::Vector3f point = rows.row(i).head<3>().cast<float>();
    if (!point.allFinite() || point.isZero(0.F)) continue;
    scan.points.push_back(point);
    const double intensity = is_share ? rows(i, 3) : rows(i, 3) / kBrightest;
    scan.intensity.push_back(static_cast<float>(std::clamp(intensity, 0., 1.)));
  }
  return scan;
}

std::vector<PoseSample> poses_of(const Scene& scene) {
  std::map<Stamp, Pose> poses;
  for (const Sweep& sweep : scene.sweeps) {
    poses.emplace(sweep.file.stamp, sweep.file.T_world_vehicle);
  }
  for (const Picture& picture : scene.pictures) {
    poses.emplace(picture.file.stamp, picture.file.T_world_vehicle);
  }
  std::vector<PoseSample> samples;
  samples.reserve(poses.size());
  for (const auto& [stamp, T_world_vehicle] : poses) samples.push_back({stamp, T_world_vehicle});
  return samples;
}

std::vector<importing::LogItem> items_of(const Scene& scene, Carrier carrier) {
  std::vector<importing::LogItem> items;
  for (const PoseSample& sample : poses_of(scene)) {
    items.push_back(
        {sample.stamp, [sample] { return importing::pose_observation(sample, "POSE"); }});
  }
  for (const Sweep& sweep : scene.sweeps) {
    items.push_back(
        {sweep.file.stamp,
         [&sweep, carrier] { return observation_from_scan(read_sweep(sweep), carrier); },
         sweep.file.path});
  }
  for (const Picture& picture : scene.pictures) {
    items.push_back({picture.file.stamp,
                     [&picture] {
                       return observation_from_image(importing::read_picture(
                           picture.file.path, picture.file.stamp, picture.camera));
                     },
                     picture.file.path});
  }
  return items;
}

importing::LabelledLog labelled_log(const Scene& scene,
                                    std::vector<importing::ObjectTrack> tracks) {
  importing::LabelledLog log;
  log.tracks = std::move(tracks);
  log.ego = poses_of(scene);
  for (const Sweep& sweep : scene.sweeps) log.scans.push_back(sweep.file.stamp);
  std::map<std::string, std::size_t> places;
  for (const Picture& picture : scene.pictures) {
    const auto [place, is_new] = places.emplace(picture.camera.label, log.cameras.size());
    if (is_new) log.cameras.push_back({picture.camera, {}});
    log.cameras[place->second].stamps.push_back(picture.file.stamp);
  }
  return log;
}

}  // namespace lidar_upsampling::dgp
