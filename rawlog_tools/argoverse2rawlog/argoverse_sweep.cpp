// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/argoverse_sweep.h"

#include <cmath>

#include "argoverse2rawlog/beams.h"
#include "argoverse2rawlog/ply.h"

namespace lidar_upsampling::argoverse {

LidarScan read_sweep(const std::string& path, Stamp stamp, const Calibration& calibration) {
  const PlyVertices vertices = read_ply(path);
  const auto &x = vertices.property("x"), &y = vertices.property("y"), &z = vertices.property("z");
  const auto& intensity = vertices.property("intensity");
  const auto& laser = vertices.property("laser_number");
  LidarScan scan;
  scan.stamp = stamp;
  scan.label = "LIDAR";
  scan.T_vehicle_lidar = calibration.T_vehicle_up_lidar;
  const Pose T_lidar_vehicle = scan.T_vehicle_lidar.inverse();
  std::vector<Eigen::Vector3d> in_vehicle;
  std::vector<int> lasers;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d point(x[i], y[i], z[i]);
    if (!point.allFinite() || point.isZero(0.)) continue;
    in_vehicle.push_back(point);
    lasers.push_back(std::isfinite(laser[i]) ? static_cast<int>(laser[i]) : -1);
    scan.points.emplace_back((T_lidar_vehicle * point).cast<float>());
    scan.intensity.push_back(static_cast<float>(intensity[i] / 255));
  }
  scan.ring = rings_of(in_vehicle, lasers, calibration);
  if (!scan.ring.empty()) scan.num_rings = kRings;
  return scan;
}

}  // namespace lidar_upsampling::argoverse
